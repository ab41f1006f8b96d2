import { expect, it } from "vitest";
import type { Limb } from "../src/messages";
import { editWords } from "../src/panel/edits/words";

const limb = { id: "7", strokes: ["b"], order: 1, locked: false } as Limb;
const edit = { limb: "7", share: [0.5], depth: [10] };

it("names the branch by when it was drawn", () => {
  expect(editWords({ ...edit, what: "held" }, [limb], ["a", "b"])).toMatchObject({ what: "Depth held", where: "branch 2" });
});

it("tells a locked limb from one that is held at some places", () => {
  expect(editWords({ ...edit, what: "held", share: [0, 1] }, [limb], ["a", "b"]).what).toBe("Depth held at 2 places");
  expect(editWords({ ...edit, what: "held" }, [{ ...limb, locked: true }], ["a", "b"]).what).toBe("Locked");
});

it("says of the trunk that it is the trunk, and of an undrawn limb that it was grown", () => {
  expect(editWords({ ...edit, what: "held" }, [{ ...limb, order: 0 }], ["a", "b"]).where).toBe("trunk");
  expect(editWords({ ...edit, what: "adopted" }, [{ ...limb, strokes: [] }], ["a", "b"]).where).toBe("a grown branch");
  expect(editWords({ ...edit, what: "cleared" }, [], [])).toEqual({ what: "Removed", where: "a grown branch", release: "Let it grow again" });
});
