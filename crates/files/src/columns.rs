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
/// Parsed from two or three numbers or names with commas between: `2,3,4` or `X,Y,Z`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Columns(pub(crate) Vec<Column>);

/// Not a choice of columns.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "\"{0}\" does not name the columns of x, y, z: give three numbers from 1 or three names, for instance 2,3,4"
)]
pub struct ColumnsError(String);

impl FromStr for Columns {
    type Err = ColumnsError;
    fn from_str(s: &str) -> Result<Columns, ColumnsError> {
        let column = |word: &str| match word.trim().parse() {
            Ok(0) => None,
            Ok(n) => Some(Column::Number(n)),
            Err(_) if word.trim().is_empty() => None,
            Err(_) => Some(Column::Name(word.trim().into())),
        };
        let columns: Option<Vec<Column>> = s.split(',').map(column).collect();
        let distinct = |c: &Vec<Column>| (1..c.len()).all(|i| !c[..i].contains(&c[i]));
        columns
            .filter(|c| matches!(c.len(), 2 | 3) && distinct(c))
            .map(Columns)
            .ok_or_else(|| ColumnsError(s.into()))
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
}
