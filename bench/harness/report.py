"""Tables for people and lines for the record."""
import json


def markdown(rows, columns):
    """A table in Markdown, aligned so that it also reads well as plain text. `columns`: (head, format or None, key)."""
    cells = [[head for head, _, _ in columns]]
    cells += [[_cell(row.get(key), form) for _, form, key in columns] for row in rows]
    widths = [max(len(line[k]) for line in cells) for k in range(len(columns))]
    lines = ["| " + " | ".join(text.ljust(w) for text, w in zip(line, widths)) + " |" for line in cells]
    lines.insert(1, "|" + "|".join("-" * (w + 2) for w in widths) + "|")
    return "\n".join(lines)


def _cell(value, form):
    if value is None:
        return "–"
    return format(value, form) if form else str(value)


CLOSEST = [
    ("program", None, "program"),
    ("build s", ".3f", "build_s"),
    ("query s", ".3f", "query_s"),
    ("CPU s", ".3f", "cpu_s"),
    ("Mpts/s", ".2f", "mpts_per_s"),
    ("quiet Mpts/s", ".2f", "quiet_mpts_per_s"),
    ("× ours", ".2f", "times_ours"),
    ("× ours, CPU", ".2f", "times_ours_cpu"),
    ("peak MB", ".0f", "peak_mb"),
    ("max error mm", ".1e", "max_error"),
    ("wrong signs", None, "wrong_signs"),
    ("noise", ".2f", "noise"),
]

GOALS = [
    ("what", None, "what"),
    ("goal", None, "goal"),
    ("wall", ".3g", "wall"),
    ("CPU", ".3g", "cpu"),
    ("", None, "met"),
]


def record(path, machine, date, rows):
    """Adds one line of JSON a row."""
    with open(path, "a", encoding="utf-8") as file:
        for row in rows:
            file.write(json.dumps({"date": date, **machine, **row}) + "\n")
