"""May the posterior be believed? Three commands, each with the bars it is held to.

    core_model   trees drawn from the model itself, exactly
    sbc          does the sampler give back what the model put in? Ranks of the truth among the samples
    budget       are the everyday samples those of a run of fifty times the length?
    coverage     do the intervals hold the depths of trees that the model did not draw?
"""
