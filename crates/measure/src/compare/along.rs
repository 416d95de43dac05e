//! Deviations along lines instead of to the nearest place: what is asked.

use std::fmt;
use std::str::FromStr;
use std::sync::Arc;
use trueness_geom::space::Vector;

/// Along what line each deviation is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AlongRule {
    /// One direction for all points, as it was given.
    Direction(Vector),
    /// The reference's normal at the nearest place.
    Reference,
    /// Each point's own normal.
    Measured,
}

impl AlongRule {
    /// The word of the result document.
    pub fn name(self) -> &'static str {
        match self {
            AlongRule::Direction(_) => "direction",
            AlongRule::Reference => "reference",
            AlongRule::Measured => "measured",
        }
    }

    /// A direction from its three components.
    ///
    /// # Errors
    /// [`NoDirection`]: they are all 0, or no numbers.
    pub fn direction(d: Vector) -> Result<AlongRule, NoDirection> {
        if d.iter().all(|x| x.is_finite()) && trueness_geom::space::unit(d).is_some() {
            Ok(AlongRule::Direction(d))
        } else {
            Err(NoDirection)
        }
    }
}

/// Three components that give no direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a direction is three numbers, not all 0")]
pub struct NoDirection;

/// A text that says no line.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoLine {
    /// Three components that give no direction.
    #[error("‘{text}’: {reason}")]
    Direction {
        /// As written.
        text: String,
        /// What is wrong with it.
        reason: NoDirection,
    },
    /// Neither a direction nor a word.
    #[error(
        "‘{text}’ is nothing to measure along; write a direction as in 0,0,1, or reference or measured for the normals of either"
    )]
    Unknown {
        /// As written.
        text: String,
    },
}

/// `X,Y,Z`, `reference` or `measured`.
///
/// # Errors
/// [`NoLine`], whatever else is written.
///
/// ```
/// use trueness_measure::compare::AlongRule;
/// assert_eq!("0,0,-2".parse(), Ok(AlongRule::Direction([0.0, 0.0, -2.0])));
/// assert!("0,0,0".parse::<AlongRule>().is_err());
/// ```
impl FromStr for AlongRule {
    type Err = NoLine;
    fn from_str(text: &str) -> Result<AlongRule, NoLine> {
        match text.trim() {
            "reference" => Ok(AlongRule::Reference),
            "measured" => Ok(AlongRule::Measured),
            other => {
                let parts: Result<Vec<f64>, _> = other.split(',').map(|x| x.trim().parse::<f64>()).collect();
                let three = parts.ok().and_then(|p| <[f64; 3]>::try_from(p).ok());
                let direction = three.map(AlongRule::direction);
                match direction {
                    Some(Ok(direction)) => Ok(direction),
                    Some(Err(reason)) => Err(NoLine::Direction { text: text.into(), reason }),
                    None => Err(NoLine::Unknown { text: text.into() }),
                }
            }
        }
    }
}

impl fmt::Display for AlongRule {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            AlongRule::Direction([x, y, z]) => write!(f, "{x},{y},{z}"),
            word => f.write_str(word.name()),
        }
    }
}

/// A rule with the points' normals, where it needs them.
#[derive(Clone, Debug)]
pub struct Lines {
    rule: AlongRule,
    normals: Arc<[Vector]>,
}

impl Lines {
    /// `normals[i]` is that of point `i`, of any length, zero for none; they are only asked for by [`AlongRule::Measured`].
    pub fn new(rule: AlongRule, normals: Vec<Vector>) -> Lines {
        Lines { rule, normals: normals.into() }
    }
    /// As asked for.
    pub fn rule(&self) -> AlongRule {
        self.rule
    }
    /// Those of the points.
    pub(super) fn normals(&self) -> Arc<[Vector]> {
        self.normals.clone()
    }
    /// How many points have a normal; `None` where none is needed.
    pub(super) fn count(&self) -> Option<usize> {
        (self.rule == AlongRule::Measured).then_some(self.normals.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_there_and_back() {
        for word in ["0,0,1", "-1.5,2,0", "reference", "measured"] {
            assert_eq!(word.parse::<AlongRule>().unwrap().to_string(), word);
        }
        for bad in ["", "0,0,0", "1,2", "1,2,3,4", "nan,0,0", "inf,0,0", "z", "normal"] {
            assert!(bad.parse::<AlongRule>().is_err(), "{bad}");
        }
    }
}
