"""DEODR, a differentiable renderer, for processors: `pip install deodr trimesh typing_extensions`."""
import numpy as np
from deodr.differentiable_renderer import Scene2DBase, renderScene


def render(corners, window):
    width, height = window
    none, three, masks = np.zeros((3, 2)), np.arange(3, dtype=np.uint32)[None], []
    for case in corners:
        scene = Scene2DBase(
            faces=three, faces_uv=three, ij=case, depths=np.ones(3), textured=np.zeros(1, bool), uv=none, shade=np.ones(3),
            colors=np.ones((3, 1)), shaded=np.zeros(1, bool), edgeflags=np.zeros((1, 3), bool), height=height, width=width,
            nb_colors=1, texture=np.zeros((0, 0)), background_color=np.zeros(1), backface_culling=False, integer_pixel_centers=False)
        image, depths = np.zeros((height, width, 1)), np.zeros((height, width))
        renderScene(scene, 0.0, image, depths)
        masks.append(image[:, :, 0] > 0)
    return np.array(masks)


def test_render(rasterproof):
    rasterproof.assert_rasterizer(render, declare="range=4096")
