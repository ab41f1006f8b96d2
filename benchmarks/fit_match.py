"""Which metric makes a sketch's own tree the likeliest? Learning the constants of `templates.weights` by cross-validation.

    python -m benchmarks.fit_match              12 new trees of every recipe, two views each; prints the figures of held-back
                                                seeds, then the constants
    python -m benchmarks.fit_match --folds 0    only the constants

Three in seven sketches have the jitter of the benchmark (1 % of the height), the others 0 to 3 %; a third lack a third or two
thirds of the limbs.
No tree, side or seed of `benchmarks.match` is among them. Two steps, taken twice:

    1. shift, sd, correlation, σ_k     moments of x_S − x_E|v over the training sketches, E their own exemplar and v its best view
                                       (correlations and harmonics shrunk a little)
    2. w_C, w_B, w_P                   conditional logit over exemplars (McFadden 1974): the greatest mean of
                                       ln [ exp u_own / Σ_E exp u_E ],    u_E = max_v Σ_k w_k term_k(S, E | v)

The weights' scale makes the scores log probabilities (up to a constant) of the exemplars, all alike beforehand. Each fold holds back whole
seeds, so trees and sides that were learnt from are none of those it is measured on.
"""

import argparse
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import minimize

from benchmarks.tree_sketch import grown, random_pencil, recipes, sketch_of
from sketchtree.templates.store.database import Database
from sketchtree.templates.exemplar import Views
from sketchtree.templates.matching.likeness import SketchShape, calibrated_terms, chen_terms
from sketchtree.templates.matching.match import sketch_shape
from sketchtree.templates.matching.metric import BRANCHING, HARMONICS, POSTURE, TRAITS, Metric, harmonics

FIRST_SEED = 1000  # of the trees grown for this
SHRINK = 0.05  # of correlations
STEMS_SD = 0.3  # log₂ of the number of stems: no hand here leaves out a stem, a person may


@dataclass(frozen=True, eq=False)
class Sample:
    """One sketch and where it came from."""

    own: int  # place of its exemplar
    seed: int
    shape: SketchShape  # with a crown
    bare: SketchShape  # without

    def of(self, crown: bool) -> SketchShape:
        """What is known with or without a crown."""
        return self.shape if crown else self.bare


def samples(db: Database, trees: int, views: int = 2, *, first_seed: int = FIRST_SEED) -> list[Sample]:
    """Sketches of new trees of every recipe."""
    made, wanted = [], [recipe for recipe in recipes() if recipe.name in db.names]
    for recipe, seed, tree in grown(wanted, range(first_seed, first_seed + trees)):
        own = db.index(recipe.name)
        rng = np.random.default_rng([seed, own])
        for _ in range(views):
            jitter, left_out = rng.choice([0, 0.005, 0.01, 0.01, 0.01, 0.02, 0.03]), rng.choice([0, 0, 0, 0, 1 / 3, 2 / 3])
            graph = sketch_of(tree, random_pencil(rng, jitter=float(jitter), left_out=float(left_out)), rng)
            made.append(Sample(own, seed, sketch_shape(graph), sketch_shape(graph.replace(crown=()))))
    return made


def fit(train: list[Sample], views: Views, crown: bool, *, diagonal: bool = False, rounds: int = 2) -> Metric:
    """The metric of sketches with a crown, or without. `diagonal`: no correlations, for comparison."""
    metric = _first(views)
    for _ in range(rounds):
        metric = _weighed(_moments(metric, train, views, crown, diagonal), train, views, crown)
    return metric


def _first(views: Views) -> Metric:
    """Half of what exemplars differ by."""
    traits = np.concatenate([views.branching.mean, views.posture], axis=-1)
    sd = np.nanstd(np.nanmean(traits, axis=1), axis=0)
    waves = np.std(views.footprint.mean(axis=1) @ harmonics(), axis=0)
    return Metric("first", np.ones(3), 0.5 * _by_harmonic(waves), np.zeros(len(TRAITS)), 0.5 * sd, np.eye(len(TRAITS)))


def _by_harmonic(coefficient):
    """Root mean square of cosine and sine."""
    pairs = np.sqrt((coefficient[1::2] ** 2 + coefficient[2::2] ** 2) / 2)
    return np.concatenate([coefficient[:1], pairs])


def _total(terms):
    return sum(term for term in terms if term is not None)


def _moments(metric: Metric, train: list[Sample], views: Views, crown: bool, diagonal: bool) -> Metric:
    traits = np.concatenate([views.branching.mean, views.posture], axis=-1)
    off, waves = [], []
    for sample in train:
        shape = sample.of(crown)
        own = _only(views, sample.own)
        best = int(np.argmax(_total(calibrated_terms(shape, own, metric))))
        off.append(shape.traits - traits[sample.own, best])
        if crown:
            waves.append((shape.footprint - views.footprint[sample.own, best]) @ harmonics())
    off = np.array(off)
    known = ~np.isnan(off)
    never = ~known.any(axis=0)  # aspect, where a crown is drawn
    shift = np.where(known, off, 0).sum(axis=0) / np.maximum(known.sum(axis=0), 1)
    away = np.where(known, off - shift, 0)
    covariance = away.T @ away / np.maximum(known.T.astype(float) @ known, 1)
    sd = np.where(never, 1.0, np.sqrt(np.diag(covariance)))
    sd[TRAITS.index("stems")] = STEMS_SD
    correlation = (1 - SHRINK) * covariance / np.outer(sd, sd) * (0 if diagonal else 1)
    np.fill_diagonal(correlation, 1.0)
    correlation[BRANCHING, POSTURE] = correlation[POSTURE, BRANCHING] = 0
    harmonic = _by_harmonic(np.sqrt(np.mean(np.square(waves), axis=0))) if crown else np.ones(HARMONICS + 1)  # not used
    return replace(metric, harmonic_sd=np.maximum(harmonic, 2e-4), shift=shift, sd=sd, correlation=correlation)


def _only(views: Views, place: int) -> Views:
    b = views.branching
    return Views(views.footprint[[place]], type(b)(b.mean[[place]], b.sd[[place]], b.count[[place]]), views.posture[[place]])


def _weighed(metric: Metric, train: list[Sample], views: Views, crown: bool) -> Metric:
    """The same metric with its weights learnt."""
    flat = replace(metric, weight=np.ones(3))
    kept = slice(0 if crown else 1, 3)
    term = np.stack([np.stack(calibrated_terms(s.of(crown), views, flat)[kept], axis=-1).astype(np.float32) for s in train])
    own, row = np.array([s.own for s in train]), np.arange(len(train))

    def loss(log_weight):
        weight = np.exp(log_weight)
        view = (term @ weight.astype(np.float32)).argmax(axis=2)
        at_best = np.take_along_axis(term, view[:, :, None, None], axis=2)[:, :, 0].astype(float)
        likely = at_best @ weight
        likely -= likely.max(axis=1, keepdims=True)
        share = np.exp(likely)
        share /= share.sum(axis=1, keepdims=True)
        slope = np.einsum("ne,nek->nk", share, at_best) - at_best[row, own]
        return -np.mean(np.log(share[row, own])), slope.mean(axis=0) * weight

    found = np.exp(minimize(loss, np.log(metric.weight[kept]), jac=True, method="L-BFGS-B").x)
    return replace(metric, weight=np.concatenate([np.zeros(3 - len(found)), found]))


def measured(held: list[Sample], crown: bool, terms, species: np.ndarray) -> np.ndarray:
    """[mean log probability of the own exemplar, own species first, own species among three, mean probability of the first]."""
    rows = []
    for sample in held:
        score = _total(terms(sample.of(crown))).max(axis=1)
        log_share = score - score.max() - np.log(np.exp(score - score.max()).sum())
        ranked = species[np.argsort(-score, kind="stable")[:3]]
        right = ranked == species[sample.own]
        rows.append([log_share[sample.own], right[0], right.any(), np.exp(log_share.max())])
    return np.mean(rows, axis=0)


def cross_validate(made: list[Sample], views: Views, species: np.ndarray, folds: int) -> None:
    """Prints what metrics learnt from the other seeds make of each fold's."""
    print(f"{'':26}{'log p':>8}{'first':>8}{'first 3':>9}{'p(first)':>10}    held-back seeds, mean of {folds} folds (standard deviation)")
    for crown in (True, False):
        shares = {"paper's sum": [], "without correlations": [], "learnt": []}
        for fold in range(folds):
            train = [s for s in made if s.seed % folds != fold]
            held = [s for s in made if s.seed % folds == fold]
            shares["paper's sum"].append(measured(held, crown, lambda shape: chen_terms(shape, views), species))
            for name, diagonal in (("without correlations", True), ("learnt", False)):
                metric = fit(train, views, crown, diagonal=diagonal)
                shares[name].append(measured(held, crown, lambda shape, m=metric: calibrated_terms(shape, views, m), species))
        print("with a crown" if crown else "without a crown")
        for name, rows in shares.items():
            mean, sd = np.mean(rows, axis=0), np.std(rows, axis=0)
            print(f"  {name:22}" + "".join(f"{m:9.3f} ({s:.3f})" for m, s in zip(mean, sd, strict=True)))


def written(name: str, metric: Metric) -> str:
    """The constants as they stand in `templates.weights`."""
    figures = metric.correlation.round(2) + 0.0
    parts = [figures[among, among] for among in (BRANCHING, POSTURE)]
    rows = [[f"            {part[i, :i].tolist()}," for i in range(1, len(part))] for part in parts]
    return "\n".join([
        f"{name} = Metric(",
        f"    name=\"{name.lower()}\",",
        f"    weight=np.array({metric.weight.round(3).tolist()}),",
        f"    harmonic_sd=np.array({metric.harmonic_sd.round(4).tolist()}),",
        f"    shift=np.array({(metric.shift.round(3) + 0.0).tolist()}),",
        f"    sd=np.array({metric.sd.round(3).tolist()}),",
        "    correlation=correlations(", "        [", *rows[0], "        ],", "        [", *rows[1], "        ],", "    ),", ")",
    ])  # fmt: skip


def main(arguments: list[str] | None = None) -> None:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.fit_match", description=__doc__.splitlines()[0])
    parser.add_argument("--trees", type=int, default=12, help="new trees of every recipe (default 12)")
    parser.add_argument("--folds", type=int, default=4, help="of the cross-validation; 0 leaves it out (default 4)")
    wanted = parser.parse_args(arguments)
    db = Database.open()
    kinds = {recipe.name: recipe.species for recipe in recipes()}
    species = np.array([kinds.get(name) or name for name in db.names])
    made = samples(db, wanted.trees)
    if wanted.folds:
        cross_validate(made, db.views, species, wanted.folds)
    for name, crown in (("CROWN", True), ("BARE", False)):
        print(written(name, fit(made, db.views, crown)))


if __name__ == "__main__":
    main()
