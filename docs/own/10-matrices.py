def product(a, b):
    columns = [transform(a, column) for column in zip(*b)]
    return [list(row) for row in zip(*columns)]


def pose(yaw, pitch, distance):
    """A turn about the y axis, then one about the x axis, then a move away from the eye."""
    s, c, t, d = math.sin(yaw), math.cos(yaw), math.sin(pitch), math.cos(pitch)
    about_y = [[c, 0.0, s, 0.0], [0.0, 1.0, 0.0, 0.0], [-s, 0.0, c, 0.0], [0.0, 0.0, 0.0, 1.0]]
    about_x = [[1.0, 0.0, 0.0, 0.0], [0.0, d, -t, 0.0], [0.0, t, d, 0.0], [0.0, 0.0, 0.0, 1.0]]
    matrix = product(about_x, about_y)
    matrix[2][3] = distance
    return matrix


def draw_cube(picture, pose, shade):
    """Draws a cube of side 2: six faces, each with its normal and its texture coordinates."""
    nearest = {}
    for axis in range(3):
        for end in range(2):
            normal = [0.0] * 4
            normal[axis] = 2.0 * end - 1.0
            normal = transform(pose, normal)[:3]
            # The four corners of the face, clockwise as seen from outside.
            p, q = 1 << (axis + 1) % 3, 1 << (axis + 2) % 3
            face = []
            for corner in (0, p, p | q, q) if end else (0, q, p | q, p):
                position = transform(pose, cube_corner(corner | end << axis) + [1.0])
                uv = [float(corner & bit != 0) for bit in (p, q)]
                face.append(transform(perspective(), position) + uv + normal)
            for triangle in face[:3], [face[0], face[2], face[3]]:
                draw(picture, nearest, triangle, shade)


def stage10():
    """A cube, turned; its colours are its normals."""
    picture = empty()
    draw_cube(picture, pose(0.6, -0.5, 4.5), lambda _u, _v, *normal: colour((1.0 - part) / 2.0 for part in normal))
    return picture
