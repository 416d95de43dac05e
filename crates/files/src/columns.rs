//! Which columns of a table are x, y and z, as the user says it.

use std::str::FromStr;

/// A column of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Column {
    /// By number, counted from 1.
    Number(usize),
    /// By the name in the header line, upper or lower case.
    Name(String),
}

/// The columns of x, y and, except for points in the plane, z.
///
/// Parsed from two or three numbers or names with commas between, `2,3,4` or `X,Y,Z`: where x, y and z are. Or, with a
/// hyphen for every column that is passed over, from what each column is, in their order: `-,x,y,z`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Columns(pub(crate) Vec<Column>);

/// Not a choice of columns.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "\"{0}\" does not name the columns of x, y, z: give three numbers from 1 or three names, for instance 2,3,4, \
     or what each column is, with - for those passed over: -,x,y,z"
)]
pub struct ColumnsError(String);

impl FromStr for Columns {
    type Err = ColumnsError;
    fn from_str(s: &str) -> Result<Columns, ColumnsError> {
        let words: Vec<&str> = s.split(',').map(str::trim).collect();
        let columns = if words.contains(&"-") { by_kind(&words) } else { by_place(&words) };
        columns.map(Columns).ok_or_else(|| ColumnsError(s.into()))
    }
}

/// Each word says where a coordinate is: by number or by name.
fn by_place(words: &[&str]) -> Option<Vec<Column>> {
    let column = |word: &&str| match word.parse() {
        Ok(0) => None,
        Ok(n) => Some(Column::Number(n)),
        Err(_) if word.is_empty() => None,
        Err(_) => Some(Column::Name((*word).into())),
    };
    let columns: Vec<Column> = words.iter().map(column).collect::<Option<_>>()?;
    let distinct = (1..columns.len()).all(|i| !columns[..i].contains(&columns[i]));
    (matches!(columns.len(), 2 | 3) && distinct).then_some(columns)
}

/// Each word says what the column at its place is: `x`, `y`, `z`, or `-` for nothing of these.
fn by_kind(words: &[&str]) -> Option<Vec<Column>> {
    let known = |word: &&str| *word == "-" || ["x", "y", "z"].iter().any(|k| word.eq_ignore_ascii_case(k));
    if !words.iter().all(known) {
        return None;
    }
    let place = |kind: &str| {
        let mut places = (1..).zip(words).filter(|(_, word)| word.eq_ignore_ascii_case(kind));
        (places.next().map(|(n, _)| Column::Number(n)), places.next().is_some())
    };
    match [place("x"), place("y"), place("z")] {
        [(Some(x), false), (Some(y), false), (z, false)] => Some([x, y].into_iter().chain(z).collect()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_names() {
        let Columns(c) = "2, 3,Höhe".parse().unwrap();
        assert_eq!(c, [Column::Number(2), Column::Number(3), Column::Name("Höhe".into())]);
        for bad in ["", "1", "1,2,3,4", "0,1,2", "1,,3", "1,1,2"] {
            assert!(bad.parse::<Columns>().is_err(), "{bad}");
        }
    }

    #[test]
    fn what_each_column_is() {
        let numbers = |text: &str| {
            let Columns(columns) = text.parse().unwrap();
            let number = |c: &Column| match c {
                Column::Number(n) => *n,
                Column::Name(name) => panic!("{name}"),
            };
            columns.iter().map(number).collect::<Vec<usize>>()
        };
        assert_eq!(numbers("-,x,y,z"), [2, 3, 4]);
        assert_eq!(numbers("z, -,Y,x"), [4, 3, 1]);
        assert_eq!(numbers("-,-,x,y"), [3, 4]);
        for bad in ["-", "-,x", "-,1,2,3", "-,x,y,z,x", "-,x,y,q", "-,,x,y"] {
            assert!(bad.parse::<Columns>().is_err(), "{bad}");
        }
    }
}
