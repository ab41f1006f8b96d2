"""The studio: draw on a page in the browser, and the tree follows the pen.

    messages      what the page and the program say to each other     typescript     the page's types, made of them
    serving       how it starts and ends                              built          where the page is, that was made of page/
    server        what the browser asks for, and gets                 security       who may ask
    session       how anyone with a page talks to it                  doing          what each request does
    desk          the drawing, its history, who looks at it           outbox         what waits to be sent to a page
    history       steps, without limit                                change         what differs between two documents
    recovery      the journal of every step                           ledger, journal_lines, scribe, locking     how it is kept
    filing        drawings in and out                                 folder, examples, underlays, exports, ids  of what
    wire          messages ↔ documents                                settling       which depths are new
    engine        what is asked of those who make trees               crew, making/  they
    cell, widget  the same in a notebook

The server and the session import neither jax nor any stage, so that the page is there at once.
"""
