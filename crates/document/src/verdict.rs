//! Answers to questions about conformity.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The answer to a question about conformity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Conforms.
    Pass,
    /// Does not conform.
    Fail,
    /// The uncertainty does not allow an answer.
    Undecided,
    /// There is no measurement to judge.
    NotMeasured,
}

impl Verdict {
    /// The word for people.
    pub fn word(self) -> &'static str {
        match self {
            Verdict::Pass => "pass",
            Verdict::Fail => "fail",
            Verdict::Undecided => "undecided",
            Verdict::NotMeasured => "not measured",
        }
    }
}

/// How bad a verdict is.
pub fn rank(verdict: Verdict) -> u8 {
    match verdict {
        Verdict::Fail => 3,
        Verdict::Undecided => 2,
        Verdict::NotMeasured => 1,
        Verdict::Pass => 0,
    }
}

/// The worst of all verdicts, whatever their order; `None` where there are none.
pub fn worst(verdicts: impl IntoIterator<Item = Verdict>) -> Option<Verdict> {
    verdicts.into_iter().max_by_key(|v| rank(*v))
}

/// The verdict on all: the worst of them.
pub fn overall(verdicts: impl IntoIterator<Item = Verdict>) -> Verdict {
    worst(verdicts).unwrap_or(Verdict::NotMeasured)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_verdict_stands_for_all() {
        use Verdict::{Fail, NotMeasured, Pass, Undecided};
        assert_eq!(overall([Pass, Undecided, Fail, NotMeasured]), Fail);
        assert_eq!(overall([Pass, NotMeasured]), NotMeasured);
        assert_eq!(overall([Pass, Pass]), Pass);
        assert_eq!([worst([NotMeasured, Fail]), worst([Fail, NotMeasured])], [Some(Fail); 2]);
        assert_eq!((worst([]), overall([])), (None, NotMeasured));
    }
}
