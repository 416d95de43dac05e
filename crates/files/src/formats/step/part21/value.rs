//! Parameters as they stand in the text.

/// A parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in super::super) enum Value<'t> {
    /// `#12`; a number beyond 64 bits is the greatest one, which no entity has.
    Reference(u64),
    Integer(i64),
    Real(f64),
    /// `.T.`, without the points.
    Word(&'t [u8]),
    /// Text as it stands between its quotes.
    Text(&'t [u8]),
    /// The values between brackets.
    List(Run),
    /// `LENGTH_MEASURE(25.4)`: the keyword as a word, then what stands between the brackets.
    Typed(Run),
    /// `$`, `*`, or binary data.
    Nothing,
}

/// Values or records that stand together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in super::super) struct Run {
    pub from: u32,
    pub count: u32,
}

impl Run {
    /// The items of the run.
    pub fn of<T>(self, all: &[T]) -> &[T] {
        let from = self.from as usize;
        all.get(from..from + self.count as usize).unwrap_or_default()
    }
}

/// A whole number that is not below 0.
pub(super) fn whole(value: Value) -> Option<usize> {
    match value {
        Value::Integer(n) => usize::try_from(n).ok(),
        _ => None,
    }
}
