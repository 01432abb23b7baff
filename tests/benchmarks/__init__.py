"""Speed, as ratios within one run, and a simulated bus under load: ``python -m tests.benchmarks``."""
