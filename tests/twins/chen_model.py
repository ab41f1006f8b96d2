"""Chen's probabilities walked pair by pair in plain Python: the slow twin of labels.py, em.py and icm.py."""

import itertools
import math


def gaussian(x, mean, sd):
    """log N(x; mean, sd) without −½ log 2π."""
    return -0.5 * ((x - mean) / sd) ** 2 - math.log(sd)


def orientation_gap(turn, mean):
    """The difference of two angles, the short way round."""
    gap = (turn - mean) % (2 * math.pi)
    return gap - 2 * math.pi if gap > math.pi else gap


def log_eq2(scale, tilt, turn, label, child_count, theta):
    """Eq. 2 of one child."""
    mu_phi, sd_phi, mu_turn, sd_turn = theta.child(label, child_count)
    value = gaussian(scale, theta.mu_s, theta.sigma_s) + gaussian(tilt, mu_phi, sd_phi)
    return value + gaussian(orientation_gap(turn, mu_turn), 0.0, sd_turn)


def best_permutation(score):
    """The best of the K! hypotheses: (total, label index of each child)."""
    children, labels = len(score), len(score[0])
    return max(
        (sum(score[c][label] for c, label in enumerate(order)), order)
        for order in itertools.permutations(range(labels), children)
    )


def vector(graph, depth, row):
    """v of one row."""
    up = graph.parent[row]
    return [*(graph.xy[row] - graph.xy[up]), depth[row] - depth[up]]


def log_icm(graph, depth, label, theta, competing, crown_radius, attenuation=5.0):
    """log P_ICM: scale and divergence of every pair, and the competition field, each pair once."""
    total = 0.0
    for row in range(len(graph)):
        if label[row] == 0:
            continue
        v, u = vector(graph, depth, row), vector(graph, depth, graph.parent[row])
        length, parent_length = math.hypot(*v), math.hypot(*u)
        angle = math.acos(max(-1, min(1, sum(a * b for a, b in zip(v, u, strict=True)) / length / parent_length)))
        mean, sd = (theta.mu_alpha, theta.sigma_alpha) if label[row] == 1 else (theta.mu_beta, theta.sigma_beta)
        total += gaussian(length / parent_length, theta.mu_s, theta.sigma_s) + gaussian(angle, mean, sd)
    for i, k in competing:
        apart = math.hypot(*(graph.xy[i] - graph.xy[k]), depth[i] - depth[k])
        total -= math.exp(-attenuation * apart / crown_radius)
    return total
