# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""What an archive's handles are like, by SQL: python3 with_duckdb.py results.parquet"""
import sys

import duckdb

handles = sys.argv[1]
frames = handles.removesuffix(".parquet") + ".frames.parquet"

print("Frames by status:")
print(duckdb.sql(f"SELECT status, count(*) AS frames, avg(num_handles) AS handles, avg(best_score) AS best_score "
                 f"FROM '{frames}' GROUP BY status ORDER BY frames DESC"))
print("The frames whose best handle is the least sure:")
print(duckdb.sql(f"SELECT f.frame, f.seq, f.best_score, h.width, h.num_points FROM '{frames}' f "
                 f"JOIN '{handles}' h ON h.frame = f.frame AND h.rank = 0 ORDER BY f.best_score, f.frame LIMIT 5"))
