"""Sheets of trees that grow toward points, as Figures 6, 7, 9, 12 and 13 of Guo et al. 2018: `python -m benchmarks.cloud_sheets -o FOLDER`."""
