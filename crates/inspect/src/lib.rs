//! What measured numbers mean: results, verdicts, reports.
