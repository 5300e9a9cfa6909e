def brightness(normal):
    """Lambert's law: the cosine between the normal and the way to the light, and a little light from everywhere."""
    towards = -0.4, 0.7, -0.6
    cosine = mix(normal, towards) / math.hypot(*normal) / math.hypot(*towards)
    return 0.25 + 0.75 * max(cosine, 0.0)


def stage11():
    """The cube, lit, textured and depth-tested."""
    picture = empty()
    draw_cube(picture, pose(0.6, -0.5, 4.5),
              lambda u, v, *normal: colour(channel * brightness(normal) for channel in checker(u, v)))
    return picture
