"""Writes the views of a camera file three times, a little apart: INPUT OUTPUT."""
import json
import sys

views = []
for number, name in enumerate(("left", "middle", "right")):
    view = dict(json.load(open(sys.argv[1]))[0])
    view.update(id=number, img_name=name, position=[0.1 * (number - 1), 0, 0])
    views.append(view)
json.dump(views, open(sys.argv[2], "w"))
