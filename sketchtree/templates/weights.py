"""The learnt metrics: of sketches with a crown, and of those without.

Made by `python -m benchmarks.fit_match`, whose docstring says how; the figures are pasted from what it prints. Of 1,080 sketches of
540 new trees, a quarter of the seeds held back in turn (jitter of 0 to 3 %, a third of them with a third or two thirds of the limbs left out):

                                     with a crown                      without
                                     log p    first    first three     log p    first    first three
    paper's sum                      −3.13    .375     .602            −3.62    .138     .299
    without correlations             −0.66    .799     .942            −0.85    .752     .896
    learnt                           −0.61    .818     .949            −0.75    .770     .916

(log p: mean log probability of the own exemplar; first: own species first.) The mean probability of the first is .807 and .765, so it may
be believed. The traits are `metric.TRAITS`: s, α, β, then the posture's features.
"""

import numpy as np

from sketchtree.templates.metric import Metric, correlations

CROWN = Metric(
    name="crown",
    weight=np.array([0.167, 0.465, 0.606]),
    harmonic_sd=np.array([0.0251, 0.0158, 0.0159, 0.0116, 0.0087, 0.0059, 0.0045, 0.0037, 0.0027, 0.0021, 0.0021, 0.0015, 0.0015]),
    shift=np.array([-0.123, 0.216, 0.191, 0.173, 0.02, 0.015, -0.001, 0.015, -0.014, 0.024, 0.027, -0.012, 0.025, 0.0]),
    sd=np.array([0.408, 0.236, 0.289, 0.169, 0.059, 0.073, 0.028, 0.109, 0.114, 0.166, 0.047, 0.11, 0.045, 0.3]),
    correlation=correlations(
        [
            [0.01],
            [0.1, 0.65],
        ],
        [
            [0.04],
            [0.02, 0.23],
            [-0.09, -0.28, 0.46],
            [-0.17, 0.05, 0.15, 0.09],
            [-0.15, 0.01, 0.11, 0.04, 0.74],
            [-0.13, -0.03, 0.06, 0.05, 0.49, 0.34],
            [0.1, -0.08, 0.11, -0.13, 0.06, 0.02, -0.02],
            [-0.03, -0.14, -0.19, -0.23, -0.2, -0.09, 0.01, -0.03],
            [-0.08, 0.09, 0.08, 0.03, -0.01, -0.14, -0.09, 0.15, -0.11],
            [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        ],
    ),
)

BARE = Metric(
    name="bare",
    weight=np.array([0.0, 0.556, 0.684]),
    harmonic_sd=np.array([1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0]),
    shift=np.array([-0.119, 0.215, 0.195, -0.12, 0.02, 0.015, -0.001, 0.011, -0.015, 0.024, 0.028, -0.013, 0.025, 0.0]),
    sd=np.array([0.393, 0.233, 0.28, 0.214, 0.059, 0.073, 0.028, 0.107, 0.112, 0.165, 0.045, 0.102, 0.044, 0.3]),
    correlation=correlations(
        [
            [0.02],
            [0.11, 0.67],
        ],
        [
            [-0.23],
            [-0.06, 0.23],
            [0.04, -0.28, 0.46],
            [-0.13, 0.04, 0.17, 0.1],
            [-0.08, 0.01, 0.13, 0.04, 0.75],
            [-0.28, -0.03, 0.06, 0.05, 0.49, 0.33],
            [0.05, -0.07, 0.11, -0.13, 0.1, 0.05, -0.01],
            [-0.09, -0.13, -0.2, -0.26, -0.25, -0.13, 0.01, -0.02],
            [0.02, 0.09, 0.08, 0.03, -0.02, -0.13, -0.09, 0.17, -0.09],
            [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        ],
    ),
)
