"""What programs that follow the links of documents share."""

import os
import sys
from urllib.parse import unquote, urlsplit


def target_of(page, link):
    """The path to which a link of the file `page` leads, and the place there that it names ("" for none); None for a
    link to elsewhere, as https: is."""
    parts = urlsplit(link)
    if parts.scheme or parts.netloc:
        return None
    path = os.path.normpath(os.path.join(os.path.dirname(page), unquote(parts.path))) if parts.path else page
    return path, unquote(parts.fragment)


def report(program, faults, pages, links):
    """Prints the faults and the counts; the exit code."""
    for fault in faults:
        print(f"{program}: error: {fault}", file=sys.stderr)
    print(f"{pages} pages, {links} links")
    return 1 if faults else 0
