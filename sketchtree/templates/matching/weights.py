"""The learnt metrics: of sketches with a crown, and of those without.

Made by `python -m benchmarks.fit_match`, whose docstring says how; the figures are pasted from what it prints. Of 1,080 sketches of
540 new trees, a quarter of the seeds held back in turn (jitter of 0 to 3 %, a third of them with a third or two thirds of the limbs left out):

                                     with a crown                      without
                                     log p    first    first three     log p    first    first three
    paper's sum                      −3.13    .375     .602            −3.62    .138     .299
    without correlations             −0.65    .807     .931            −0.85    .752     .895
    learnt                           −0.60    .821     .946            −0.75    .772     .917

(log p: mean log probability of the own exemplar; first: own species first.) The mean probability of the first is .813 and .771, so it may
be believed. The traits are `metric.TRAITS`: s, α, β, then the posture's features.
"""

import numpy as np

from sketchtree.templates.matching.metric import Metric, correlations

CROWN = Metric(
    name="crown",
    weight=np.array([0.205, 0.498, 0.667]),
    harmonic_sd=np.array([0.0253, 0.0156, 0.0169, 0.0114, 0.0085, 0.0059, 0.0044, 0.0037, 0.0027, 0.0021, 0.002, 0.0014, 0.0015]),
    shift=np.array([-0.115, 0.217, 0.192, 0.0, 0.02, 0.015, -0.001, 0.014, -0.015, 0.025, 0.028, -0.012, 0.025, 0.0]),
    sd=np.array([0.403, 0.238, 0.289, 1.0, 0.059, 0.073, 0.028, 0.109, 0.115, 0.166, 0.047, 0.109, 0.045, 0.3]),
    correlation=correlations(
        [
            [0.02],
            [0.1, 0.64],
        ],
        [
            [0.0],
            [0.0, 0.23],
            [0.0, -0.28, 0.46],
            [0.0, 0.05, 0.16, 0.1],
            [0.0, 0.01, 0.11, 0.04, 0.74],
            [0.0, -0.03, 0.06, 0.05, 0.49, 0.34],
            [0.0, -0.08, 0.1, -0.13, 0.05, 0.02, -0.03],
            [0.0, -0.12, -0.18, -0.23, -0.21, -0.1, 0.01, -0.04],
            [0.0, 0.09, 0.08, 0.02, -0.02, -0.14, -0.09, 0.14, -0.1],
            [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        ],
    ),
)

BARE = Metric(
    name="bare",
    weight=np.array([0.0, 0.569, 0.69]),
    harmonic_sd=np.array([1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0]),
    shift=np.array([-0.119, 0.215, 0.195, -0.12, 0.02, 0.015, -0.001, 0.012, -0.015, 0.024, 0.028, -0.012, 0.025, 0.0]),
    sd=np.array([0.393, 0.233, 0.281, 0.213, 0.059, 0.073, 0.028, 0.107, 0.112, 0.165, 0.045, 0.102, 0.044, 0.3]),
    correlation=correlations(
        [
            [0.02],
            [0.11, 0.66],
        ],
        [
            [-0.24],
            [-0.06, 0.23],
            [0.04, -0.28, 0.46],
            [-0.13, 0.04, 0.17, 0.1],
            [-0.08, 0.01, 0.13, 0.05, 0.75],
            [-0.29, -0.03, 0.06, 0.05, 0.48, 0.33],
            [0.05, -0.07, 0.11, -0.13, 0.1, 0.05, -0.01],
            [-0.09, -0.13, -0.2, -0.26, -0.25, -0.13, 0.01, -0.02],
            [0.02, 0.09, 0.08, 0.03, -0.02, -0.13, -0.09, 0.17, -0.09],
            [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        ],
    ),
)
