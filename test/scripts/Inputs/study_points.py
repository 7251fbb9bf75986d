"""Measures two points by bench/study.py; usage: study_points.py BENCH FOLDER SCENE CAMERAS [kept]"""
import os
import sys

bench, folder, scene, cameras, *more = sys.argv[1:]
sys.path.insert(0, bench)
import scenes
import study

of = scenes.with_views(scene, cameras, ("front",))
points = [study.render("plain", of, "front", "--time", keep=(".pfm",)),
          study.render("lanes", of, "front", "--time", may_be_refused=True, VORION_SET="timing.raster.lanes=77")]
if more == ["kept"]:
    print(*("there" if result else "missing" for result in study.kept(points, folder)))
else:
    plain, lanes = study.measure(points, folder, jobs=2)
    assert os.path.getsize(study.file_of(folder, points[0], ".pfm")) > 0
    print(plain["report"]["time"]["sum"]["cycles"], lanes["refused"], sep="\n")
