"""The log posterior of the default method, factor by factor, in plain Python. Slow on purpose.

`kinds(graph, psi, theta)` is {kind: Σ}, straight from the equations; `statistics` and `collapsed` do the conjugate
part. Loops only, no padding, no index arrays of the fast version but those of `FactorGraph`.
"""

import math

KAPPA, C = 0.5, {1: 1.0, 2: 0.5, 3: 0.25}


def vectors(graph, psi):
    """V and L of every row, tips, and Λ of every limb."""
    v, length, tip = [], [], []
    limb_length = [0.0] * graph.limb_count
    for i in range(len(graph)):
        if graph.is_base[i]:
            v.append((0.0, 1.0, 0.0))
            length.append(0.0)
            tip.append((graph.xy[i][0], graph.xy[i][1], 0.0))
            continue
        c, s = math.cos(psi[i]), math.sin(psi[i])
        v.append((graph.direction[i][0] * c, graph.direction[i][1] * c, s))
        length.append(graph.length[i] / c)
        above = tip[graph.parent[i]]
        tip.append((graph.xy[i][0], graph.xy[i][1], above[2] + graph.length[i] * math.tan(psi[i])))
        limb_length[graph.limb[i]] += length[i]
    return v, length, tip, limb_length


def angle(u, v):
    cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    return math.atan2(math.sqrt(sum(c * c for c in cross) + 1e-12), sum(a * b for a, b in zip(u, v)))


def lateral_limbs(graph):
    return [j for j in range(graph.limb_count) if graph.limb_parent[j] >= 0]


def spreading_limbs(graph):
    """Laterals, and stems of trees that have three or more."""
    stems = [j for j in range(graph.limb_count) if graph.limb_parent[j] < 0]
    tree = [graph.tree[graph.limb_tip[j]] for j in range(graph.limb_count)]
    shrub = [j for j in stems if sum(tree[k] == tree[j] for k in stems) >= 3]
    return sorted(lateral_limbs(graph) + shrub)


def divergences(graph, psi):
    """(order 1 or 2, a) of every lateral limb."""
    v, *_ = vectors(graph, psi)
    out = []
    for j in lateral_limbs(graph):
        first = graph.limb_first[j]
        out.append((min(graph.limb_order[j], 2), angle(v[first], v[graph.parent[first]])))
    return out


def excesses(graph, psi):
    """(order 1 or 2, r_j − b (u_j − ½)) of every lateral limb."""
    *_, limb_length = vectors(graph, psi)
    out = []
    for j in lateral_limbs(graph):
        r = math.log(limb_length[j] + 1e-9) - math.log(limb_length[graph.limb_parent[j]] + 1e-9)
        out.append((min(graph.limb_order[j], 2), r + 0.8 * (graph.insertion[j] - 0.5)))
    return out


def log_lengths(graph, psi):
    """(order 1 or 2, log L) of every segment that is no stem's."""
    _, length, *_ = vectors(graph, psi)
    rows = [i for i in range(len(graph)) if not graph.is_base[i] and graph.order[i] > 0]
    return [(min(graph.order[i], 2), math.log(length[i] + 1e-9)) for i in rows]


def bends(graph, psi):
    """(order 0, 1 or 2, a) of every segment that continues its limb."""
    v, *_ = vectors(graph, psi)
    rows = [i for i in range(len(graph)) if graph.is_apical[i]]
    return [(min(graph.order[i], 2), angle(v[i], v[graph.parent[i]])) for i in rows]


def kinds(graph, psi, theta):
    """{kind of factor: sum of its log potentials}. `theta` has lists: divergence_mean, ... as LimbTheta."""
    v, length, tip, limb_length = vectors(graph, psi)
    out = dict.fromkeys(
        ("solid_angle", "lateral", "apical", "stem", "limb_length", "segment_length", "siblings", "competition", "extent", "crown"), 0.0
    )
    for i in range(len(graph)):
        if not graph.is_base[i]:
            out["solid_angle"] += math.log(math.cos(psi[i]))
    for o, a in divergences(graph, psi):
        m, s = theta.divergence_mean[o - 1], theta.divergence_sd[o - 1]
        out["lateral"] += -0.5 * ((a - m) / s) ** 2 - math.log(s) - math.log(math.sin(a) + 0.02)
    for o, a in bends(graph, psi):
        tau = theta.bend_sd[o]
        out["apical"] += -0.5 * (a / tau) ** 2 - 2 * math.log(tau)
    for o, r in excesses(graph, psi):
        m, s = theta.length_mean[o - 1], theta.length_sd[o - 1]
        out["limb_length"] += -0.5 * ((r - m) / s) ** 2 - math.log(s)
    for o, x in log_lengths(graph, psi):
        m, s = theta.segment_mean[o - 1], theta.segment_sd[o - 1]
        out["segment_length"] += -0.5 * ((x - m) / s) ** 2 - math.log(s)
    for j in range(graph.limb_count):
        if graph.limb_parent[j] < 0:
            out["stem"] += -0.5 * (psi[graph.limb_first[j]] / (0.5 if j in spreading_limbs(graph) else 0.08)) ** 2
    out["siblings"] = siblings(graph, v)
    for i, k in graph.competitor:
        d = math.sqrt(sum((a - b) ** 2 for a, b in zip(tip[i], tip[k])) + 1e-8)
        out["competition"] -= math.exp(-5.0 * d / graph.crown_radius)
    out["extent"] = extent_and_balance(graph, tip)
    for j in spreading_limbs(graph):
        t = graph.limb_tip[j]
        dx = graph.xy[t][0] - graph.trunk_x[j]
        rho = math.sqrt(dx**2 + tip[t][2] ** 2 + 1e-8) / max(graph.half_width[j], 0.06)
        m, s = (0.0, 0.2) if graph.limb_order[j] <= 1 else (-0.12, 0.35)
        out["crown"] -= weight_of(graph, graph.tree[t]) * math.log(1 + ((math.log(rho) - m) / s) ** 2)
    return out


def siblings(graph, v):
    """Σ −κ c_d w_j · w_k over limbs on one parent limb, ranked by insertion."""
    total = 0.0
    hosts = [[(graph.insertion[j], j) for j in lateral_limbs(graph) if graph.limb_parent[j] == p] for p in range(graph.limb_count)]
    shrub = [j for j in spreading_limbs(graph) if graph.limb_parent[j] < 0]
    for tree in sorted({int(graph.tree[graph.limb_tip[j]]) for j in shrub}):
        own = [j for j in shrub if graph.tree[graph.limb_tip[j]] == tree]
        hosts.append([(graph.xy[graph.limb_first[j]][0], j) for j in own])
    for host in hosts:
        ranked = sorted(host)
        sideways = [_sideways(v[graph.limb_first[j]], v[graph.parent[graph.limb_first[j]]]) for _, j in ranked]
        for a in range(len(sideways)):
            for b in range(a + 1, min(a + 4, len(sideways))):
                total -= KAPPA * C[b - a] * sum(x * y for x, y in zip(sideways[a], sideways[b]))
    return total


def _sideways(v, axis):
    along = sum(a * b for a, b in zip(v, axis))
    w = [a - along * b for a, b in zip(v, axis)]
    norm = math.sqrt(sum(x * x for x in w) + 1e-6)
    return [x / norm for x in w]


def weight_of(graph, tree):
    """1, less where every tip of the tree is on one side."""
    dx = [graph.xy[graph.limb_tip[j]][0] - graph.trunk_x[j] for j in spreading_limbs(graph) if graph.tree[graph.limb_tip[j]] == tree]
    rms = math.sqrt(sum(x * x for x in dx) / len(dx))
    one_sided = abs(sum(dx) / len(dx)) / max(rms, 1e-9)
    return 1 - 0.85 * min(max((one_sided - 0.7) / 0.2, 0.0), 1.0)


def extent_and_balance(graph, tip):
    """Both factors of every tree that has a lateral."""
    total = 0.0
    for tree in sorted(set(graph.tree.tolist())):
        limbs = [j for j in spreading_limbs(graph) if graph.tree[graph.limb_tip[j]] == tree]
        if not limbs:
            continue
        z = [tip[graph.limb_tip[j]][2] for j in limbs]
        square = sum((graph.xy[graph.limb_tip[j]][0] - graph.trunk_x[j]) ** 2 for j in limbs)
        r = 0.5 * math.log((sum(x * x for x in z) + 1e-6) / (square + 1e-6))
        rms = math.sqrt(square / len(limbs) + 1e-6)
        total += weight_of(graph, tree) * (-0.5 * (r / 0.2) ** 2 - 0.5 * (sum(z) / len(z) / rms / 0.35) ** 2)
    return total


def normal_update(m0, k0, nu0, s0, x):
    """Normal-Inverse-Gamma posterior (m, κ, ν, s²)."""
    n = len(x)
    mean = sum(x) / n if n else 0.0
    total = nu0 * s0 + sum((v - mean) ** 2 for v in x) + k0 * n * (mean - m0) ** 2 / (k0 + n)
    return (k0 * m0 + n * mean) / (k0 + n), k0 + n, nu0 + n, total / (nu0 + n)
