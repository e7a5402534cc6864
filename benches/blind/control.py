"""A parametric control beside trials of unknown objects: F tests on the same draws, of which one knows how often they are wrong.

The linear model at what was drawn: the scanner's errors, every station's pose, every object's numbers. Rows are whitened by what their
readings' noise makes of them. Of each of a few effects with two coefficients an F test, the smallest p times their number
(Bonferroni): where nothing is planted, at most one draw in twenty is below 0.05, whatever the share of the command.
"""
import copy

import numpy as np

STEP = 1e-6
# What turns by which reading, how often a turn: two coefficients each, a cosine and a sine.
TESTED = [("azimuth", 1), ("azimuth", 2), ("azimuth", 3), ("elevation", 2), ("elevation", 3), ("elevation", 4)]


def smallest_p(scanner, placed, walls, rows, noise):
    """Of rows (station, object, readings as they would be without noise, and as they are); `walls` by name, none of targets."""
    stations = list(placed)
    objects = sorted({name for _, name, _, _ in rows})
    true, noisy = (np.array([row[at] for row in rows]).T for at in (2, 3))
    turn = np.stack([placed[label][0] for label, *_ in rows])
    shift = np.stack([placed[label][1] for label, *_ in rows])
    # What is planted is no part of the model.
    declared_alone = copy.copy(scanner)
    declared_alone.effect = "nothing"
    at = lambda readings, of=declared_alone: np.einsum("nij,nj->ni", turn, of.point(*readings)) + shift
    there = at(true, scanner)
    by_reading = np.stack([(at(noisy + s) - at(noisy - s)) / (2 * STEP) for s in STEP * np.eye(3)[:, :, None]], -1)

    # Columns of the point, n x 3 each.
    columns = []
    for number in range(len(scanner.errors)):
        moved = [copy.copy(declared_alone), copy.copy(declared_alone)]
        for one, sign in zip(moved, (1, -1)):
            one.errors = [error + sign * STEP * (place == number) for place, error in enumerate(scanner.errors)]
        columns.append((at(noisy, moved[0]) - at(noisy, moved[1])) / (2 * STEP))
    for label in stations:
        own = np.array([row[0] == label for row in rows])[:, None]
        for axis in np.eye(3):
            columns += [own * axis, own * np.cross(axis, there - shift)]
    for name in objects if not walls else []:
        own = np.array([row[1] == name for row in rows])[:, None]
        columns += [own * -axis for axis in np.eye(3)]
    declared = len(columns)
    for reading, times in TESTED:
        place = ("azimuth", "elevation").index(reading)
        columns += [by_reading[:, :, place] * wave(times * noisy[place])[:, None] for wave in (np.cos, np.sin)]

    left, columns = at(noisy) - there, np.stack(columns, -1)
    if walls:
        # Only how far off its plane a point lies counts, and a plane can tip and shift.
        normal = np.stack([np.array(walls[row[1]][0]) / np.linalg.norm(walls[row[1]][0]) for row in rows])
        across = lambda each: np.einsum("ni,ni...->n...", normal, each)[:, None]
        planes = []
        for name in objects:
            own = np.array([row[1] == name for row in rows], float)
            others = np.linalg.svd(normal[own > 0][:1])[2][1:]
            planes += [own * (there @ other) for other in others] + [own]
        planes = np.stack(planes, -1)[:, None]
        left, by_reading, columns = across(left), across(by_reading), across(columns)
        columns = np.concatenate([columns[..., :declared], planes, columns[..., declared:]], -1)
        declared += planes.shape[-1]

    spread = by_reading * np.array(noise)
    whiten = np.linalg.inv(np.linalg.cholesky(spread @ np.swapaxes(spread, 1, 2)))
    left = (whiten @ left[..., None]).ravel()
    columns = (whiten @ columns).reshape(len(left), -1)
    columns /= np.linalg.norm(columns, axis=0)
    u, singular, _ = np.linalg.svd(columns[:, :declared], full_matrices=False)
    basis = u[:, singular > 1e-9 * singular[0]]
    project = lambda each: each - basis @ (basis.T @ each)
    residual = project(project(left))
    smallest = 1.0
    for pair in range(declared, columns.shape[1], 2):
        q = np.linalg.qr(project(project(columns[:, pair : pair + 2])))[0]
        gained = float(((q.T @ residual) ** 2).sum())
        free = len(left) - basis.shape[1] - 2
        # The F distribution with two degrees of freedom above has a closed form.
        ratio = gained / 2 / ((residual @ residual - gained) / free)
        smallest = min(smallest, (1 + 2 * ratio / free) ** (-free / 2))
    return min(1.0, smallest * len(TESTED))
