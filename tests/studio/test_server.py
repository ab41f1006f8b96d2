"""The server lets in only its own page, answers what that asks for, and stays alive whatever is thrown at it."""

import asyncio
import io
import json
import socket
import threading
import time
import zipfile
from contextlib import ExitStack
from urllib.parse import quote

import pytest
from fake_engine import FakeEngine
from running import running
from talking import drawn, stroke
from websockets.exceptions import ConnectionClosed, InvalidStatus

from sketchtree.errors import OptionError
from sketchtree.studio import messages, outbox, patience
from sketchtree.studio.outbox import encode
from sketchtree.studio.recovery import journal_of
from sketchtree.studio.server import Studio

PNG = bytes.fromhex(
    "89504e470d0a1a0a0000000d49484452000000020000000108020000007b40e8dd0000000c4944415478da63f8ffff3f0005fe02fea72d6e140000000049454e44ae426082"
)


@pytest.fixture(scope="module")
def shelf(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("SKETCHTREE_RECOVERY", str(tmp_path_factory.mktemp("shelf")))
        yield


@pytest.fixture(scope="module")
def studio(tmp_path_factory, shelf):
    """One server for all tests that leave it as it is."""
    with running(tmp_path_factory.mktemp("drawings")) as server:
        yield server


@pytest.fixture
def own(tmp_path, monkeypatch):
    """A server of the test's own."""
    monkeypatch.setenv("SKETCHTREE_RECOVERY", str(tmp_path / "shelf"))
    with running(tmp_path) as server:
        yield server


def told(socket, kind: str, *, tries: int = 500) -> dict:
    """The next event of a kind."""
    for _ in range(tries):
        said = socket.recv(timeout=10)
        if isinstance(said, str) and (event := json.loads(said))["type"] == kind:
            return event
    raise AssertionError(f"no {kind}")


# Who may


def test_the_token_is_exchanged_for_a_cookie_and_leaves_the_address(studio):
    answer = studio.get(f"/?token={studio.token}", Cookie=None)
    assert answer.status_code == 303 and answer.headers["location"] == "/"
    cookie = answer.headers["set-cookie"]
    assert cookie.startswith(f"{studio.cookie};") and "HttpOnly" in cookie and "SameSite=strict" in cookie and "Path=/" in cookie
    assert studio.get("/").text == "<!doctype html><title>page</title>"


@pytest.mark.parametrize("path", ["/", "/?token=wrong", "/?token=", "/assets/page-1.js", "/download", "/command", "/texture/bark/color.png", "/nothing"])
def test_without_the_token_nothing_is_answered(studio, path):
    answer = studio.get(path, Cookie=None)
    assert answer.status_code == 403 and answer.text == "Not allowed. Open the address that `sketchtree studio` printed.\n"


@pytest.mark.parametrize("cookie", ["x=1", "sketchtree-{port}=wrong", "sketchtree-{port}=", "a=\u00e9;;;=", "sketchtree-{port}=\u00e9"])
def test_a_wrong_cookie_is_none(studio, cookie):
    assert studio.get("/", Cookie=cookie.format(port=studio.port).encode("latin-1")).status_code == 403


@pytest.mark.parametrize("host", ["evil.example", "127.0.0.1", "localhost", "127.0.0.1:1", "127.0.0.1:{port}.evil.example", "evil.example:{port}", "[::1]:{port}", ""])
def test_a_foreign_host_is_refused(studio, host):
    assert studio.get(f"/?token={studio.token}", Host=host.format(port=studio.port)).status_code in (400, 403)
    assert studio.get("/", Host=host.format(port=studio.port)).status_code in (400, 403)


def test_localhost_is_the_same_machine(studio):
    assert studio.get("/", Host=f"localhost:{studio.port}").status_code == 200


@pytest.mark.parametrize("origin", [None, "null", "http://evil.example", "https://127.0.0.1:{port}", "http://127.0.0.1:1", "http://localhost:{port}", "http://127.0.0.1:{port}/"])
@pytest.mark.parametrize("path", ["/upload?name=a.svg", "/export"])
def test_a_post_from_elsewhere_is_refused(studio, origin, path):
    answer = studio.post(path, b"{}", Origin=origin and origin.format(port=studio.port))
    assert answer.status_code == 403


@pytest.mark.parametrize("options", [{"origin": "http://evil.example"}, {"origin": None}, {"headers": {"Cookie": "x=1"}}, {"headers": {"Host": "evil.example"}}])
def test_a_websocket_from_elsewhere_is_refused(studio, options):
    with pytest.raises((InvalidStatus, ConnectionClosed)) as refused, studio.page(**options):
        pass
    assert refused.type is ConnectionClosed or refused.value.response.status_code in (400, 403)


def test_it_listens_on_this_machine_alone(studio):
    others = {info[4][0] for info in socket.getaddrinfo(socket.gethostname(), None, socket.AF_INET)} - {"127.0.0.1"}
    for address in others:
        with socket.socket() as other, pytest.raises(OSError):
            other.settimeout(2)
            other.connect((address, studio.port))


@pytest.mark.parametrize("path", ["/", "/nothing", "/command", "/download", "/texture/bark/color.png"])
@pytest.mark.parametrize("cookie", [True, False])
def test_every_answer_forbids_what_is_not_ours(studio, path, cookie):
    headers = studio.get(path, **({} if cookie else {"Cookie": None})).headers
    policy = headers["content-security-policy"]
    assert policy == (
        f"default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self' ws://{studio.host}; "
        "worker-src 'self' blob:; frame-ancestors 'none'; base-uri 'none'; form-action 'none'"
    )
    assert headers["x-content-type-options"] == "nosniff" and headers["cache-control"] == "no-store" and headers["referrer-policy"] == "no-referrer"
    assert headers["cross-origin-opener-policy"] == headers["cross-origin-resource-policy"] == "same-origin" and "server" not in headers


def test_who_opens_connections_and_says_nothing_or_half_a_request_is_not_waited_for(monkeypatch, tmp_path, shelf):
    monkeypatch.setattr(patience, "SECONDS", 0.2)
    with running(tmp_path) as server, ExitStack() as open_ones, server.page() as page:
        idle = [open_ones.enter_context(socket.create_connection(("127.0.0.1", server.port), timeout=10)) for _ in range(50)]
        for one in idle[::2]:
            one.sendall(b"GET / HTTP/1.1\r\nHost: 127.0.0.1\r\nX: ")
        assert all(_is_closed(one) for one in idle)
        server.hello(page)
        assert told(page, "welcome")  # a page is no such


def _is_closed(one: socket.socket) -> bool:
    try:
        return one.recv(1) == b""
    except ConnectionResetError:
        return True


@pytest.mark.parametrize(
    "said",
    [b"\x16\x03\x01\x02\x00\x01\x00", b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n", b"X" * 200_000, b"GET /" + b"a" * 100_000 + b" HTTP/1.1\r\n",
     b"GET / HTTP/1.1\r\nHost: x\r\nContent-Length: " + b"9" * 5000 + b"\r\n\r\n", b"GET / HTTP/1.1\r\n" + b"A: b\r\n" * 50_000,
     b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 3\r\nTransfer-Encoding: chunked\r\n\r\nabc", b"GET /ws HTTP/1.1\r\nHost: x\r\nUpgrade: h2c\r\nConnection: upgrade\r\n\r\n",
     b"GET /ws HTTP/1.1\r\nHost: x\r\nUpgrade: websocket\r\nConnection: upgrade\r\n\r\n", b"\x00" * 1000],
)  # fmt: skip
def test_what_is_no_request_gets_an_error_or_nothing(studio, said):
    with socket.create_connection(("127.0.0.1", studio.port), timeout=30) as line:
        try:
            line.sendall(said)
            answer = line.recv(100)
        except (ConnectionResetError, BrokenPipeError):
            answer = b""
    assert not answer or answer.startswith((b"HTTP/1.1 4", b"HTTP/1.0 4"))
    assert studio.get("/").status_code == 200


def test_no_message_is_unpacked(studio):
    """Compressed messages are not negotiated: a small one can't become a large one."""
    with studio.page(compression="deflate") as page:
        assert "sec-websocket-extensions" not in page.response.headers


# What is there


def test_the_built_page_is_served_and_nothing_beside_it(studio):
    script = studio.get("/assets/page-1.js")
    assert script.text == "export {};" and script.headers["content-type"] == "text/javascript; charset=utf-8"
    for path in ("/assets/", "/assets/../index.html", "/../secret.js", "/assets/..%2f..%2fsecret.js", "/assets/%2e%2e/%2e%2e/secret.js", "//etc/passwd", "/assets\\..\\secret.js", "/%00"):
        assert studio.raw(path) == (404, "There is nothing here.\n")


def test_an_unknown_path_is_not_said_again(studio):
    answer = studio.get("/<script>alert(1)</script>")
    assert answer.status_code == 404 and "script" not in answer.text


def test_pictures_come_from_the_engine(studio):
    for path in ("/texture/bark/color.png", "/picture/template/oak.png"):
        assert studio.get(path).content == b"\x89PNG" and studio.get(path).headers["content-type"] == "image/png"
    for path in ("/texture/none/color.png", "/picture/leaf/oak.png", "/texture/..%2f..%2fx/color.png", "/underlay/00", "/texture/bark/..%2fx.png"):
        assert studio.get(path).status_code == 404


def test_another_method_is_refused(studio):
    assert studio.ask("DELETE", "/", Origin=studio.base).status_code == 405


# Messages


def test_a_stroke_goes_to_all_pages(own):
    with own.page() as one, own.page() as other:
        own.hello(one), own.hello(other)
        told(one, "changed"), told(other, "changed")
        one.send(encode(drawn("a")))
        assert told(one, "changed") == (event := told(other, "changed")) and event["put"][0]["id"] == "a"


def test_the_tree_comes_as_a_binary_frame(own):
    with own.page() as page:
        own.hello(page)
        said = [page.recv(timeout=10) for _ in range(4)]
        assert own.engine.whole in said


DEEP = "[" * 100_000 + "]" * 100_000


@pytest.mark.parametrize(
    "said",
    ["", "{", "null", "[]", "1e999", '{"type":"explode"}', '{"type":"undo","x":1}', '{"type":"hello"}', DEEP, '{"type":"strokes","label":"x","put":' + DEEP + "}",
     '{"type":"strokes","label":"x","put":[{"id":"a","kind":"branch","xy":[NaN,1]}]}', '{"type":"strokes","label":"x","put":[{"id":"a","kind":"branch","xy":[1e999,1]}]}',
     '{"type":"strokes","label":"x","put":[{"id":"a","kind":"branch","xy":[1e7,1]}]}', '{"type":"strokes","label":"x","put":[{"id":"a\\u0000","kind":"branch","xy":[1,1]}]}',
     '{"type":"strokes","label":"x","put":[{"id":"\\ud800","kind":"branch","xy":[1,1]}]}', '{"type":"save","name":"../x"}', '{"type":"open","name":"a/b"}',
     '{"type":"flip","limb":"-1"}', '{"type":"flip","limb":"' + "9" * 5000 + '"}', '{"type":"choose","options":{"seed":' + "9" * 5000 + "}}", b"\xff\xfe", b"\x80\x04K\x01."],
)  # fmt: skip
def test_a_message_that_is_none_is_refused_and_nothing_happens(studio, said):
    with studio.page() as page:
        studio.hello(page)
        revision = told(page, "changed")["revision"]
        page.send(said)
        trouble = told(page, "trouble")
        assert trouble["about"] == "message" and trouble["message"].startswith("A message of the page can't be read: ") and trouble["remedy"] == "Load the page again."
        page.send(encode(messages.Strokes(label="nothing")))
        assert told(page, "changed")["revision"] == revision


def test_a_message_that_is_too_large_ends_the_connection_and_no_other(studio):
    with studio.page() as other:
        with studio.page() as page:
            studio.hello(page)
            with pytest.raises(ConnectionClosed) as closed:
                page.send("x" * 5_000_000)
                while True:
                    page.recv(timeout=10)
            assert closed.value.rcvd is None or closed.value.rcvd.code == 1009
        studio.hello(other)
        assert told(other, "welcome")


def test_ten_thousand_rapid_strokes_leave_it_alive(own):
    own.engine.answers = False
    with own.page() as page:
        own.hello(page)
        told(page, "changed")
        for k in range(10_000):
            page.send(encode(messages.Strokes(label="branch", put=[stroke(f"s{k}", k, 0, k, -10)])))
        page.send(encode(messages.Undo()))
        deadline = time.monotonic() + 120
        known = 1
        while time.monotonic() < deadline:
            event = told(page, "changed", tries=100_000)
            assert event["since"] in (0, known)  # nothing is left out
            known = event["revision"]
            if known == 10_002:
                break
        assert known == 10_002
    assert len(own.engine.made[-1][1].strokes) == 10_001  # and the two of the example


def test_a_slow_reader_gets_the_newest_and_not_a_growing_heap(own):
    with own.page() as slow, own.page() as quick:
        own.hello(slow), own.hello(quick)
        told(quick, "changed"), told(slow, "changed")
        own.engine.size = 1_000_000
        for k in range(60):
            quick.send(encode(drawn(f"s{k}")))
            told(quick, "changed")
        size = 0
        ids: set[str] = set()
        while "s59" not in ids:
            said = slow.recv(timeout=20)
            size += len(said)
            if isinstance(said, str) and (event := json.loads(said))["type"] == "changed":
                ids = (set() if event["since"] == 0 else ids) | {one["id"] for one in event["put"]}
        assert {f"s{k}" for k in range(60)} <= ids and size < 40_000_000  # of 60 MB


# Files


def test_a_file_of_the_folder_is_opened_and_can_be_undone(own):
    (own.folder / "birch.svg").write_text("<svg/>")
    (own.folder / ".hidden.svg").write_text("<svg/>")
    (own.folder / "notes.txt").write_text("")
    with own.page() as page:
        own.hello(page)
        first = told(page, "changed")
        welcome = told(page, "welcome")
        assert welcome["files"] == ["birch.svg"] and welcome["folder"] == own.folder.name
        page.send(encode(messages.Open(name="birch.svg")))
        opened = told(page, "changed")
        assert [one["id"] for one in opened["put"]] == ["birch.svg-0", "birch.svg-1"] and opened["undo"] == "open" and opened["name"] == "birch"
        page.send(encode(messages.Undo()))
        assert [one["id"] for one in told(page, "changed")["put"]] == [one["id"] for one in first["put"]]


@pytest.mark.parametrize("name", ["..", ".hidden.svg", "a:b.svg", "con.svg", "NUL", "x.svg ", "link.svg", "pipe.svg", "folder.svg", "nothing.svg", "%2e%2e"])
def test_no_other_file_can_be_opened(own, name, tmp_path_factory):
    outside = tmp_path_factory.mktemp("outside") / "secret.svg"
    outside.write_text("secret")
    (own.folder / ".hidden.svg").write_text("secret")
    (own.folder / "link.svg").symlink_to(outside)
    (own.folder / "folder.svg").mkdir()
    import os

    os.mkfifo(own.folder / "pipe.svg")
    with own.page() as page:
        own.hello(page)
        told(page, "changed")
        page.send(encode(messages.Open(name=name)))
        trouble = told(page, "trouble")
        assert "secret" not in str(trouble) and trouble["remedy"]
        page.send(encode(messages.Save(name=name)))
        event = json.loads(next(said for said in iter(lambda: page.recv(timeout=10), None) if isinstance(said, str) and json.loads(said)["type"] in ("trouble", "saved")))
        assert event["type"] == "trouble" or event["name"] in ("nothing.svg", "%2e%2e", "link.svg", "pipe.svg", "folder.svg", "x.svg ")
    assert outside.read_text() == "secret" and (own.folder / ".hidden.svg").read_text() == "secret"
    assert {path.name for path in own.folder.parent.iterdir() if path.suffix == ".sketchtree"} == set()


def test_saving_writes_the_project_and_asks_before_another_file_goes(own):
    with own.page() as page:
        own.hello(page)
        told(page, "changed")
        page.send(encode(drawn("a")))
        page.send(encode(messages.Save(name="übung 1")))
        saved = told(page, "saved")
        assert saved["name"] == "übung 1" and "übung 1.sketchtree" in saved["files"] and b'"a"' in (own.folder / "übung 1.sketchtree").read_bytes()
        page.send(encode(messages.Save(name="übung 1")))
        assert told(page, "saved")
        (own.folder / "other.sketchtree").write_text("mine")
        page.send(encode(messages.Save(name="other")))
        assert told(page, "trouble")["message"] == "other.sketchtree is there already."
        page.send(encode(messages.Save(name="other.sketchtree", over=True)))
        assert told(page, "saved")["name"] == "other"
        (own.folder / "other.sketchtree").write_text("changed elsewhere")
        page.send(encode(messages.Save(name="other")))
        assert told(page, "trouble")["message"] == "other.sketchtree has been changed by another program."


def test_an_opened_project_is_as_in_its_file_until_something_changes(own):
    (own.folder / "mine.sketchtree").write_text('{"strokes": ["a", "b"]}')
    with own.page() as page:
        own.hello(page)
        told(page, "changed")
        page.send(encode(messages.Open(name="mine.sketchtree")))
        assert told(page, "changed")["saved"]
        page.send(encode(drawn("c")))
        assert not told(page, "changed")["saved"]
        page.send(encode(messages.Undo()))
        assert told(page, "changed")["saved"]
        page.send(encode(messages.Save(name="mine")))
        assert told(page, "saved")["name"] == "mine"


def test_an_upload_opens_as_a_step(own):
    answer = own.post("/upload?name=elm.svg", b"<svg/>")
    assert answer.status_code == 200 and answer.json()["revision"] == 2
    with own.page() as page:
        own.hello(page)
        assert [one["id"] for one in told(page, "changed")["put"]] == ["elm.svg-0", "elm.svg-1"]
        assert own.post("/upload?name=bad.svg", b"bad").json() == {"message": "bad.svg is no drawing.", "remedy": "Draw one."}
        page.send(encode(messages.Undo()))
        assert told(page, "changed")["redo"] == "open"


@pytest.mark.parametrize("name", ["../x.svg", "", ".x.svg", "a/b.svg", "con.svg", "a\\b.svg", "x" * 300 + ".svg", "a\x00.svg"])
def test_an_upload_with_a_name_that_is_none_is_refused(studio, name):
    answer = studio.ask("POST", f"/upload?name={''.join(f'%{byte:02x}' for byte in name.encode())}", b"<svg/>", Origin=studio.base)
    assert answer.status_code == 422 and answer.json()["message"] == "That is no name of a drawing."


def test_a_picture_to_trace_over_is_served_as_it_came_and_moved_by_the_page(own):
    assert own.post("/upload?name=photo.png&as=underlay", PNG).status_code == 200
    with own.page() as page:
        own.hello(page)
        under = told(page, "changed")["underlay"]
        assert under["width"] == 2 * under["height"]
        answer = own.get(f"/underlay/{under['digest']}")
        assert answer.content == PNG and answer.headers["content-type"] == "image/png"
        page.send(encode(messages.SetUnderlay(underlay=messages.Underlay(**(under | {"opacity": 0.9})))))
        moved = told(page, "changed")
        assert moved["underlay"]["opacity"] == 0.9 and moved["underlay_changed"]
        page.send(encode(messages.SetUnderlay()))
        assert told(page, "changed")["underlay"] is None
        page.send(encode(messages.SetUnderlay(underlay=messages.Underlay(digest="0" * 32, x=0, y=0, width=1, height=1))))
        assert told(page, "trouble")["message"] == "That picture is not here any more."


@pytest.mark.parametrize(("data", "said"), [(b"<svg/>", "x.png is no picture that can be traced over."), (b"\x89PNG\r\n\x1a\nno", "x.png can't be read as a picture.")])
def test_what_is_no_picture_is_not_traced_over(studio, data, said):
    answer = studio.post("/upload?name=x.png&as=underlay", data)
    assert answer.status_code == 422 and answer.json()["message"] == said


def test_an_upload_that_is_too_large_is_not_read(studio, monkeypatch):
    assert studio.raw("/upload?name=a.svg", "POST", Content_Length=str(messages.MAX_UPLOAD + 1))[0] == 413
    monkeypatch.setattr(messages, "MAX_UPLOAD", 1000)

    def endless():
        for _ in range(100):
            yield b"x" * 100

    answer = studio.post("/upload?name=a.svg", endless())
    assert answer.status_code == 413 and answer.json()["message"].startswith("The file is too large: ")


def test_an_export_is_one_file_or_several_in_a_zip(own):
    own.post("/upload?name=%C3%BCbung.svg", b"<svg/>")
    one = own.post("/export", json.dumps({"format": ".glb", "revision": 2}))
    assert one.content == b"one" and one.headers["content-disposition"] == "attachment; filename=\"_bung.glb\"; filename*=UTF-8''%C3%BCbung.glb"
    several = own.post("/export", json.dumps({"format": ".glb", "levels": "apart"}))
    with zipfile.ZipFile(io.BytesIO(several.content)) as archive:
        assert archive.namelist() == ["räum/tree.png", "übung.glb"] and archive.read("räum/tree.png") == b"two"
    assert several.headers["content-disposition"].endswith("%C3%BCbung.zip")


def test_an_export_can_be_of_the_growth_of_any_tree(own):
    own.post("/upload?name=oak.svg", b"<svg/>")
    for format, tree, growth, said in ((".usdz", "drawn", {}, b"drawn full 0 10"), (".gif", "photo", {"mode": "age", "bend": -12.5, "seconds": 4}, b"photo age -12.5 4")):
        answer = own.post("/export", json.dumps({"format": format, "tree": tree, "growth": growth}))
        assert answer.content == said and f"oak{format}" in answer.headers["content-disposition"]


def test_pages_are_told_how_far_it_is_under_the_id_that_it_was_asked_with(own):
    own.post("/upload?name=oak.svg", b"<svg/>")
    with own.page() as page:
        own.hello(page)
        for address, more, stage in (("/export", {"format": ".glb"}, "mesh"), ("/growth", {}, "grow")):
            own.post(address, json.dumps({"id": stage, **more}))
            assert told(page, "making") == {"type": "making", "id": stage, "stage": stage, "done": 0.5}


def test_an_export_that_nobody_waits_for_any_more_ends(own, monkeypatch):
    begun, ended = threading.Event(), threading.Event()

    async def endless(self, *asked):
        begun.set()
        try:
            await asyncio.Event().wait()
        finally:
            ended.set()

    monkeypatch.setattr(FakeEngine, "moving", endless)
    body = json.dumps({"format": ".gif", "growth": {}}).encode()
    with socket.create_connection((own.host.split(":")[0], own.port)) as line:
        head = f"POST /export HTTP/1.1\r\nHost: {own.host}\r\nOrigin: {own.base}\r\nCookie: {own.cookie}\r\nContent-Length: {len(body)}\r\n\r\n"
        line.sendall(head.encode() + body)
        assert begun.wait(20)
    assert ended.wait(20)


def test_what_cannot_be_exported_says_why(studio):
    answer = studio.post("/export", json.dumps({"format": ".glb", "solid": True}))
    assert answer.status_code == 422 and answer.json() == {"message": "`--solid` needs a package.", "remedy": "Install it."}


@pytest.mark.parametrize("said", ["", "{}", '{"format": "../x"}', '{"format": ".glb", "lod": 9}', '{"format": ".glb", "x": 1}', DEEP[:9000]])
def test_an_export_that_is_none_is_refused(studio, said):
    answer = studio.post("/export", said)
    assert answer.status_code == 400 and answer.json()["message"].startswith("What to export can't be read: ")


def test_the_project_can_be_kept_and_the_command_line_copied(own):
    with own.page() as page:
        own.hello(page)
        told(page, "changed")
        page.send(encode(messages.Choose(options={"template": "oak", "gravity": 0.5, "generations": 3, "planar": True, "seed": 7, "season": "autumn"})))
        told(page, "changed")
        page.send(encode(messages.Save(name="my tree's")))
        told(page, "saved")
    assert own.get("/download").headers["content-disposition"].endswith("my%20tree%27s.sketchtree")
    assert own.get("/command").text == (
        "sketchtree build 'my tree'\"'\"'s.sketchtree' -o 'my tree'\"'\"'s.glb' --template oak --planar --generations 3 --sag 0.5 --season autumn --seed 7"
    )
    assert own.get("/command?export=" + quote(json.dumps({"format": ".usdz", "lod": 2, "wood": "tubes"}))).text.endswith("s.usdz' --template oak --planar --generations 3 --sag 0.5 --season autumn --wood tubes --lod 2 --seed 7")
    assert own.get("/command?export=" + quote('{"format": "/etc"}')).status_code == 400
    grown = {"format": ".mp4", "growth": {"mode": "age", "bend": -20, "seconds": 4}}
    assert own.get("/command?export=" + quote(json.dumps(grown))).text.endswith("s.mp4' --mode age --bend -20 --seconds 4")


# Beginning


def test_the_first_drawing_is_the_file_or_an_example(tmp_path, shelf):
    drawing = tmp_path / "mine.svg"
    drawing.write_text("<svg/>")
    with running(tmp_path, drawing) as server, server.page() as page:
        server.hello(page)
        event = told(page, "changed")
        assert [one["id"] for one in event["put"]] == ["mine.svg-0", "mine.svg-1"] and event["name"] == "mine" and event["undo"] is None and event["saved"]
    with running(tmp_path) as server, server.page() as page:
        server.hello(page)
        event = told(page, "changed")
        assert [one["id"] for one in event["put"]] == ["oak_50.svg-0", "oak_50.svg-1"] and event["saved"]  # nothing of the user's is in it
    with running(tmp_path, tmp_path / "new.sketchtree") as server, server.page() as page:
        server.hello(page)
        event = told(page, "changed")
        assert event["put"] == [] and event["name"] == "new" and not event["saved"]


def test_a_taken_port_is_told(studio, tmp_path):
    with pytest.raises(OptionError, match=rf"^Port {studio.port} is taken\. Give another one with `--port`, or leave the option out\.$"), running(tmp_path, port=studio.port):
        pass


def test_what_was_drawn_is_there_after_it_ended_in_any_way(tmp_path, shelf):
    project = tmp_path / "oak.sketchtree"
    with running(tmp_path, project) as server, server.page() as page:
        server.hello(page)
        told(page, "changed")
        page.send(encode(drawn("a")))
        told(page, "changed")
    with running(tmp_path, project) as server, server.page() as page:
        server.hello(page)
        event = told(page, "changed")
        assert [one["id"] for one in event["put"]] == ["a"] and event["undo"] == "branch"
        assert told(page, "welcome")["recovered"]
    journal_of(project).close()


def test_the_routes_are_those_that_are_documented():
    from sketchtree.studio import server as documented

    for name in ("ws", "texture", "picture", "underlay", "upload", "export", "download", "command"):
        assert f"/{name}" in documented.__doc__ and callable(Studio)


def test_a_page_that_can_not_be_told_what_is_new_is_let_go_so_that_it_comes_back_and_the_others_go_on(own, monkeypatch, capsys):
    with own.page() as one, own.page() as other:
        for page in (one, other):
            own.hello(page)
            told(page, "changed")
        taken = outbox.Outbox._taken

        def failing(box):
            monkeypatch.setattr(outbox.Outbox, "_taken", taken)
            raise ValueError("cannot tell")

        monkeypatch.setattr(outbox.Outbox, "_taken", failing)
        one.send(encode(drawn("a")))
        gone = 0
        for page in (one, other):
            try:
                assert [stroke["id"] for stroke in told(page, "changed")["put"]] == ["a"]
            except ConnectionClosed:
                gone += 1
        assert gone == 1 and "cannot tell" in capsys.readouterr().err
        with own.page() as again:
            own.hello(again)
            assert "a" in [stroke["id"] for stroke in told(again, "changed")["put"]]
