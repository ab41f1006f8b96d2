"""The machine's browser, for the files that need one."""

import pytest


@pytest.fixture(scope="module")
def browser():
    """Closed after each file: Playwright's loop runs on in its thread, and other tests have loops of their own."""
    from browser import launch

    playwright, browser = launch()
    yield browser
    browser.close()
    playwright.stop()
