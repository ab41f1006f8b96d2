"""`sketchtree doctor`: does everything work here?"""

import json

import click


@click.command("doctor")
@click.option("--json", "as_json", is_flag=True, help="One JSON object a check.")
def doctor(as_json: bool) -> None:
    """Check the installation: packages, templates, jax, OpenGL, extras. Exit status 1 if the main job can't work."""
    from sketchtree import health

    broken = 0
    for check in health.checks():
        broken += not check.fine and check.weight == health.NEEDED
        if as_json:
            click.echo(json.dumps({"name": check.name, "fine": check.fine, "needed": check.weight == health.NEEDED, "found": check.found, "remedy": check.remedy}))
        else:
            click.echo(check.line)
    if broken:
        raise click.exceptions.Exit(1)
