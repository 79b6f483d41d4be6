# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""What an archive's handles are like, with pandas and pyarrow: python3 with_pandas.py results.parquet"""
import sys

import pandas

handles = pandas.read_parquet(sys.argv[1])
frames = pandas.read_parquet(sys.argv[1].removesuffix(".parquet") + ".frames.parquet")

print(frames.groupby("status")[["num_handles", "best_score"]].mean())
best = handles[handles["rank"] == 0]
print(best[["score", "width", "px", "py", "pz"]].describe().loc[["mean", "min", "50%", "max"]])
