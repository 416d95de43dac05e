//! Rows that lack a cell or have one too many: read to the numbers that were written, or refused at their line.

use super::*;
use trueness_geom::space::Point;

fn read(text: &str) -> std::result::Result<Vec<Point>, String> {
    ends_tests::read(text.as_bytes())
}

/// Tables with a row that would be read as other numbers, or lost; the line and what the refusal must say.
const REFUSED: &[(&str, &[&str])] = &[
    (
        "1;2;3;9;0\n4;5;6;9;0\n8;9;7;0\n2;2;1;9;0\n",
        &["line 3", "a row of 5 cells", "found 4", "missing cell"],
    ),
    ("id,X,Y,Z,q\nP1,1,2,3,9\nP2,4,5,6,9\nP3,-8.5,7,9\nP4,2,2,1,9\n", &["line 4", "a row of 5 cells"]),
    ("id;X;Y;Z;q\nP1;1;2;3;9\nP2;4;5;6;9\nP3;8;9;7\nP4;2;2;1;9\n", &["line 4", "a row of 5 cells"]),
    ("1\t2\t3\t9\n4\t5\t6\t9\n8.5\t9\t7\n2\t2\t1\t9\n", &["line 3", "a row of 4 cells"]),
    // The cells of a label and of a note keep their kind where a number is missing between them.
    ("P1;1;2;3;ok\nP2;4;5;6;ok\nP3;8;9;ok\n", &["line 3", "a row of 5 cells"]),
    ("P1;1;2;3;9;ok\nP2;4;5;6;9;ok\nP3;8;9;7;ok\n", &["line 3", "a row of 6 cells"]),
    ("P1;1;2;3;9;ok\nP2;4;5;6;9;ok\n8;9;7;9;ok\n", &["line 3", "a row of 6 cells"]),
    ("P1;1;2;3;9\nP2-4;5;6;9\nP3;8;9;7;9\n", &["line 2", "a row of 5 cells"]),
    ("1;2;3;9;-\n4;5;6;9;-\n8;7;9;-\n", &["line 3"]),
    // Between blanks the numbers before a text are counted.
    ("1 2 3 9 top\n4 5 6 9 left side\n8 7 9 top\n2 2 1 9\n", &["line 3"]),
    ("1 2 3 9 top\n4 5 6 9 left side\n8 7 9 -\n2 2 1 9\n", &["line 3"]),
    ("1 2 3 top\n4 5 6 left side\n7 8\n2 2 1\n", &["line 3"]),
    ("1 2 3 top\n4 5 6 left side\n0.5 7 8 9\n2 2 1\n1 1 1 a\n", &["line 3", "3 cells and text behind"]),
    // Before all others.
    ("title\nP0\nP1,1,2,3\nP2,4,5,6\n", &["line 2", "a row of 4 cells"]),
    ("title\nP0;7\nP1;1;2;3\nP2;4;5;6\n", &["line 2", "a row of 4 cells"]),
    (
        "title\n0-99.5\t-7\t92\t0.5\t\t\tok\n1\t-2\t1\t3\t0.7\t\t\tok\n2\t1\t6\t1\t0.1\t\t\tok\n",
        &["line 2", "a row of 8"],
    ),
    ("title\n8;7;9;ok\n1;2;3;9;ok\n4;5;6;9;ok\n", &["line 2", "a row of 5 cells"]),
    ("# id x y z\nP0-8;7;9\nP1;1;2;3\nP2;4;5;6\n", &["line 2", "a row of 4 cells"]),
    ("title\n0.5;P0;8;7;9\nP1;1;2;3\nP2;4;5;6\n", &["line 2"]),
    ("title\n-8.5\n1;2;3\n4;5;6\n", &["line 2"]),
    // A table larger than what stands behind it in another way of writing.
    ("1,5;2,5;3,5;ok\n4,5;5,5;6,5;ok\n7,5;8,5;9,5;ok\n2,5;8,5;1,5;ok\nmean;1.0;1.0\n", &["line 5", "mean"]),
    ("1,5;2,5;3,5;ok\n4,5;5,5;6,5;ok\nn;12.5;0.5;1.5\n", &["line 3"]),
    ("1,5 2,5 3,5 ok\n4,5 5,5 6,5 ok\nmean 1.0 1.0\n", &["line 3"]),
    ("1;20,5;30,5;a\n2;21,5;31,5;b\n3;22,5;32,5;a\nmean;1.0;1.0\n", &["line 4", "mean"]),
];

#[test]
fn rows_that_lack_a_cell_are_refused_at_their_line() {
    let mut wrong = vec![];
    for (text, words) in REFUSED {
        match read(text) {
            Ok(points) => wrong.push(format!("{text}{points:?}")),
            Err(said) if words.iter().all(|w| said.contains(w)) => {}
            Err(said) => wrong.push(format!("{text}{said} lacks some of {words:?}")),
        }
    }
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), REFUSED.len(), wrong.join("\n"));
}

#[test]
fn text_behind_the_numbers_may_be_missing_or_of_several_words() {
    let want = [[1.5, 2.0, -3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.5]];
    for text in [
        "1.5 2 -3 top\n4 5 6 left side\n7 8 9.5\n",
        "1.5 2 -3 left side of it\n4 5 6 top\n7 8 9.5 top\n",
        "x y z note\n1.5 2 -3 left side\n4 5 6 right side\n7 8 9.5 top\n",
        "1.5 2 -3 77 top\n4 5 6 78 left 2\n7 8 9.5 nan\n".replace("nan", "79").as_str(),
        "P1 1.5 2 -3 top\nP2 4 5 6 left side\nP3 7 8 9.5\n",
        "title\nP1;1.5;2;-3\nP2;4;5;6;ok;late\nP3;7;8;9.5;ok;late\n",
        "1.5;2;-3\n4;5;6;a note\n7;8;9.5;\n",
        "Scan of 12 parts\n1.5;2;-3;9\n4;5;6;9\n7;8;9.5;9\n",
        "NACA 0012\nTemperature 20.5\n1.5 2 -3\n4 5 6\n7 8 9.5\n",
        "Operator;Smith\nTemperature;20.5\nP1;1.5;2;-3\nP2;4;5;6\nP3;7;8;9.5\n",
    ] {
        assert_eq!(read(text).unwrap_or_else(|said| panic!("{text}\n{said}")), want, "{text}");
    }
}

struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) as usize % n
    }
    fn one<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())]
    }
}

/// The fault of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    Nothing,
    Missing,
    Cut,
    Glued,
    Extra,
}

/// A table with a fault in one row, and the points that its other rows and this one meant.
fn table(random: &mut Random, fault: Fault) -> (String, Vec<Point>) {
    let separator = random.one(&[";", ",", "\t", " ", "; "]);
    let blanks = separator == " ";
    let comma = matches!(separator, ";" | " " | "; ") && random.below(2) == 0;
    let (n, label, extra, notes) =
        (5 + random.below(12), random.below(2) == 0, random.below(4), random.below(3));
    let number = |x: f64| if comma { format!("{x:.3}").replace('.', ",") } else { format!("{x:.3}") };
    let middle = random.below(n);
    let broken = random.one(&[0, 1, middle, n - 1]);
    let (mut points, mut lines) = (vec![], vec![]);
    let names = random.below(3);
    if names == 0 {
        lines.push("measured by someone".into());
    } else if names == 1 && notes < 2 {
        let mut all = if label { vec!["id"] } else { vec![] };
        all.extend(["X", "Y", "Z"]);
        all.extend(["i", "j", "k"][..extra].iter());
        all.extend(["note"][..notes].iter());
        lines.push(all.join(separator));
    }
    for row in 0..n {
        let mut value = || (random.below(200_000) as f64 - 100_000.0) / 1000.0;
        let point = [value(), value(), value()];
        let mut cells: Vec<String> = if label { vec![format!("P{row}")] } else { vec![] };
        cells.extend(point.map(number));
        cells.extend((0..extra).map(|_| number(value())));
        for _ in 0..notes {
            let words: &[&str] =
                if blanks { &["ok", "left side", "a b c"] } else { &["ok", "late", "left side", "", "-"] };
            cells.push(random.one(words).into());
        }
        if row == broken {
            match fault {
                Fault::Nothing => {}
                Fault::Missing => _ = cells.remove(random.below(cells.len())),
                Fault::Cut => cells.truncate(1 + random.below(cells.len() - 1)),
                Fault::Glued => {
                    let at = random.below(cells.len() - 1);
                    let next = cells.remove(at + 1);
                    cells[at] += &next;
                }
                Fault::Extra => cells.insert(random.below(cells.len()), number(7.5)),
            }
        }
        points.push(point);
        lines.push(cells.join(separator));
    }
    (lines.join("\n") + "\n", points)
}

/// Rates over random tables: none is read to other points, and all without a fault are read.
#[test]
fn random_tables_are_read_right_or_refused() {
    let mut random = Random(5);
    let mut wrong = vec![];
    for fault in [Fault::Nothing, Fault::Missing, Fault::Cut, Fault::Glued, Fault::Extra] {
        let (mut right, mut told, all) = (0, 0, 600);
        for _ in 0..all {
            let (text, points) = table(&mut random, fault);
            match read(&text) {
                Ok(found) if found == points => right += 1,
                Err(said) if fault == Fault::Nothing => wrong.push(format!("{text}{said}")),
                Err(said) => {
                    assert!(said.contains("line ") && said.contains(';'), "{said}");
                    told += 1;
                }
                Ok(found) => wrong.push(format!("{fault:?}\n{text}{} points", found.len())),
            }
        }
        println!("{fault:?}: {right} right, {told} told, {} wrong", all - right - told);
    }
    let some: Vec<&String> = wrong.iter().step_by(wrong.len() / 8 + 1).collect();
    let some: Vec<&str> = some.iter().map(|s| s.as_str()).collect();
    assert!(wrong.is_empty(), "{} wrong, some of them:\n{}", wrong.len(), some.join("\n"));
}

/// Rows with decimal commas, and what other programs write behind them with decimal points.
#[test]
fn what_stands_behind_a_table_is_never_read_instead_of_it() {
    let mut random = Random(9);
    let (mut wrong, mut told) = (vec![], 0);
    for _ in 0..1500 {
        let (text, points) = table(&mut random, Fault::Nothing);
        let comma = text.lines().any(|l| l.contains(',') && !l.contains('.'));
        if text.contains('.') || !comma {
            continue;
        }
        let separator = if text.contains(';') {
            ";"
        } else if text.contains('\t') {
            "\t"
        } else {
            " "
        };
        let footer = random.one(&["mean;1.0;1.0", "n;12;0", "x;1.0;1.0;1.0", "mean;1,0;1,0"]);
        let text = text + &footer.replace(';', separator) + "\n";
        match read(&text) {
            Err(_) => told += 1,
            Ok(found) if found == points => {}
            Ok(found) => wrong.push(format!("{text}{} of {} points", found.len(), points.len())),
        }
    }
    println!("{told} told, {} wrong", wrong.len());
    let first = wrong.first().map_or("", |s| s.as_str());
    assert!(wrong.is_empty(), "{} wrong:\n{first}", wrong.len());
}

/// A fault on a row that stands elsewhere in the contour than in the file.
#[test]
fn faults_of_an_airfoil_are_told_at_their_lines() {
    let side = |sign: f64| {
        (0..20).map(move |i| (f64::from(i) / 19.0, sign * 0.1)).map(|(x, y)| format!("{x:.4} {y:.4}"))
    };
    let mut lines: Vec<String> =
        ["title".into(), "20 20".into()].into_iter().chain(side(1.0)).chain(side(-1.0)).collect();
    assert_eq!(read(&lines.join("\n")).unwrap().len(), 40);
    lines[4] = lines[4].replace(' ', ",");
    let said = read(&lines.join("\n")).unwrap_err();
    assert!(said.contains("line 5"), "{said}");
}
