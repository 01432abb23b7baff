"""One program a target, for Atheris and ClusterFuzzLite."""
