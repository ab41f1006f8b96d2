"""Is Θ found again in trees drawn from it? How often each of the eight parameters lies within two standard errors.

    python -m benchmarks.theta                  200 trees of every Θ below
    python -m benchmarks.theta --trees 40

A tree is drawn as Chen et al. 2008 (§4) say: a child is v_c = s R_y(ϕ) R_x(φ) v_p with s, φ and ϕ normal, of the means and
deviations that Θ gives the child's label. A normal φ now and then is below 0: that is the same as −φ turned by π, and is left so.
For normal estimates 95.4 % lie within two standard errors, and of 200 trees 1.5 % more or fewer by chance; the bar is 93 %.
"""

import argparse

import numpy as np

from sketchtree.parameters import TreeParameters
from sketchtree.skeleton import TreeSkeleton
from sketchtree.templates.estimate import estimate
from sketchtree.templates.theta_errors import standard_errors

BAR = 0.93
SHORTEST = 0.2  # least s
PAIRS = 100  # a tree of fewer is drawn again: standard errors are of many values


def theta_of(mu_s, sigma_s, *degrees) -> TreeParameters:
    """Θ from its scale and its angles in degrees."""
    return TreeParameters(mu_s, sigma_s, *np.radians(degrees).tolist())


THETAS = {
    "broadleaf": theta_of(0.9, 0.15, 15, 4, 50, 6, 40, 12),
    "conifer": theta_of(0.8, 0.1, 8, 2, 80, 8, -70, 15),
    "loose": theta_of(0.85, 0.2, 25, 7, 60, 15, 150, 30),
}


def tree_of(theta: TreeParameters, seed: int, *, generations: int = 6, most: int = 4) -> tuple[TreeSkeleton, np.ndarray]:
    """A tree drawn from Θ, 1 to `most` children a segment, and the truth of its pairs: s, φ, ϕ, whether apical (pair, 4)."""
    rng = np.random.default_rng(seed)
    while len((drawn := _drawn(theta, rng, generations, most))[1]) < PAIRS:
        pass
    return drawn


def _drawn(theta: TreeParameters, rng: np.random.Generator, generations: int, most: int) -> tuple[TreeSkeleton, np.ndarray]:
    parent, tip, order, limb = [-1, 0], [np.zeros(3), np.array([0.0, 1.0, 0.0])], [0, 0], [0, 0]
    frame, size, truth = {1: np.eye(3)}, {1: 1.0}, []
    front = [1]
    for _ in range(generations):
        new = []
        for row in front:
            count = int(rng.integers(1, most + 1))
            for label in range(1, count + 1):
                mean_phi, sd_phi, mean_gamma, sd_gamma = theta.child(label, count)
                phi, gamma = rng.normal(mean_phi, sd_phi), rng.normal(mean_gamma, sd_gamma)
                s = max(SHORTEST, rng.normal(theta.mu_s, theta.sigma_s))
                child = len(parent)
                frame[child] = frame[row] @ _about_y(gamma) @ _about_x(phi)
                size[child] = s * size[row]
                parent.append(row)
                tip.append(tip[row] + size[child] * frame[child] @ [0, 1, 0])
                order.append(order[row] + (label > 1))
                limb.append(limb[row] if label == 1 else child)
                turned = gamma if phi >= 0 else gamma + np.pi
                truth.append((s, abs(phi), np.angle(np.exp(1j * turned)), label == 1))
                new.append(child)
        front = new
    n = len(parent)
    tree = TreeSkeleton.from_columns(parent, np.array(tip), np.full(n, 0.01), order=np.array(order), limb=np.array(limb))
    return tree, np.array(truth, float)


def misses(theta: TreeParameters, trees: int, *, first_seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """(estimate − truth, standard error), each (tree, parameter); μ_γ's miss goes the short way round."""
    errors, sizes = [], []
    truth = np.array(list(theta.as_dict().values()))
    for seed in range(first_seed, first_seed + trees):
        tree, _ = tree_of(theta, seed)
        miss = np.array(list(estimate(tree).as_dict().values())) - truth
        miss[6] = np.angle(np.exp(1j * miss[6]))
        errors.append(miss)
        sizes.append(list(standard_errors(tree).as_dict().values()))
    return np.array(errors), np.array(sizes)


def coverage(error: np.ndarray, size: np.ndarray) -> np.ndarray:
    """Share of the trees whose estimate lies within two standard errors of the truth, a parameter."""
    return (np.abs(error) <= 2 * size).mean(axis=0)


def _about_x(t):
    return np.array([[1, 0, 0], [0, np.cos(t), -np.sin(t)], [0, np.sin(t), np.cos(t)]])


def _about_y(t):
    return np.array([[np.cos(t), 0, np.sin(t)], [0, 1, 0], [-np.sin(t), 0, np.cos(t)]])


def main(arguments: list[str] | None = None) -> None:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.theta", description=__doc__.splitlines()[0])
    parser.add_argument("--trees", type=int, default=200, help="trees of every Θ (default 200)")
    count = parser.parse_args(arguments).trees
    print(f"{'Θ':10} {'parameter':12} {'truth':>8} {'mean error':>11} {'s.e.':>8} {'within 2 s.e.':>14}   bar {BAR:.0%}")
    found = {name: misses(theta, count, first_seed=k * count) for k, (name, theta) in enumerate(THETAS.items())}
    for name, (error, size) in found.items():
        _print_rows(name, THETAS[name], error, size)
    pooled = (np.concatenate(column) for column in zip(*found.values(), strict=True))
    _print_rows("all", None, *pooled)


def _print_rows(name: str, theta: TreeParameters | None, error: np.ndarray, size: np.ndarray) -> None:
    truth = THETAS["broadleaf"] if theta is None else theta
    for p, (parameter, value) in enumerate(truth.as_dict(degrees=True).items()):
        unit = 1.0 if parameter.endswith("_s") else 180 / np.pi
        share = coverage(error[:, p], size[:, p])
        shown = f"{value:8.2f}" if theta is not None else " " * 8
        verdict = "met" if share >= BAR else "missed"
        print(f"{name:10} {parameter:12} {shown} {error[:, p].mean() * unit:+11.3f} {size[:, p].mean() * unit:8.3f} {share:14.1%}   {verdict}")


if __name__ == "__main__":
    main()
