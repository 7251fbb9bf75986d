import numpy as np
import vorion

scene = vorion.Scene.read("scene.ply")
views = vorion.cameras(scene, "cameras.json", orbit=8)
picture = vorion.Machine().render(scene, views[0], time=True)
reveal_type(picture.image)
reveal_type(picture.cycles)
reveal_type(views)
vorion.cameras(scene, orbit="8")
scene.means = scene.means - np.float32(1)
