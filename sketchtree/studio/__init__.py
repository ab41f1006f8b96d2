"""The studio: draw on a page in the browser, and the tree follows the pen.

    messages      what the page and the program say to each other         typescript   the page's types, made of them
    server        the web server: routes, who may ask what                session      one document, its pages, what each request does to it
    engine        what the server asks of those who make trees            page/        the page's sources

The server and the session import neither jax nor any stage, so that the page is there at once.
"""
