//! The methods of a paper for the join of one line and one curve.

use super::found::Sections;
use crate::exit::Usage;
use crate::progress::Stage;
use clap::{Args, ValueEnum};
use trueness_section::{self as section, Method, Options, Search, SectionError, SegmentKind};

/// How the join of a line and a curve is found, if not by the likelihood of the whole contour.
#[derive(Args, Debug)]
#[command(next_help_heading = "One line and one curve")]
pub struct MethodArgs {
    /// Find one join, that of a line at an end of the row and one curve: golden-section search between points, the measured
    /// point where the curvature leaves the line's, or golden section about that; all three stand in the table
    #[arg(long, value_enum, value_name = "NAME")]
    search: Option<SearchArg>,
    /// Interval of the golden-section search: from the likelihood, or from the paper's 3 σ and correlation
    /// [default: profile]
    #[arg(long, value_enum, value_name = "NAME")]
    interval: Option<IntervalArg>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum SearchArg {
    Golden,
    Stepwise,
    Improved,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum IntervalArg {
    Profile,
    Paper,
}

/// The method chosen, the interval's name, and all methods with the points of their curves.
pub type Table = (Search, &'static str, Vec<(Method, usize)>);

impl MethodArgs {
    fn chosen(&self) -> Option<Search> {
        match (self.search, self.interval) {
            (None, None | Some(IntervalArg::Profile)) => None,
            (None, Some(IntervalArg::Paper)) | (Some(SearchArg::Golden), _) => Some(Search::Golden),
            (Some(SearchArg::Stepwise), _) => Some(Search::Stepwise),
            (Some(SearchArg::Improved), _) => Some(Search::Improved),
        }
    }

    /// Refuses the methods where there is no row of points in order.
    pub fn only_for_rows(&self) -> Result<(), Usage> {
        match self.chosen() {
            None => Ok(()),
            Some(_) => {
                Err(Usage("--search and --interval paper are for points in order, not for planes".into()))
            }
        }
    }

    /// The contour of the method asked for in place of that found, if one was.
    pub fn apply(
        &self,
        (mut sections, rows): Sections,
        options: &Options,
        stage: &Stage,
    ) -> Result<(Sections, Option<Table>), SectionError> {
        let (Some(chosen), Some(points)) = (self.chosen(), rows.first()) else {
            return Ok(((sections, rows), None));
        };
        let Some(found) = sections.first_mut().and_then(|s| s.contours.first_mut()) else {
            return Ok(((sections, rows), None));
        };
        let profile = self.interval != Some(IntervalArg::Paper);
        let first = found.segments.first().is_some_and(|s| s.geometry.kind() == SegmentKind::Line);
        let join = if first { found.joins.first() } else { found.joins.last() };
        let interval = join.filter(|_| profile).map(|j| j.interval);
        let (methods, reversed) = section::line_and_curve(points, found, interval, stage)?;
        let kept = points.len() - found.outliers.len() - found.repeated.len();
        if let Some(method) = methods.iter().find(|m| m.search == chosen) {
            *found = section::method_contour(points, found, method, reversed, options);
        }
        let table = methods.into_iter().map(|m| (kept - m.on_line, m));
        let table = table.map(|(on_curve, m)| (m, on_curve)).collect();
        // Where the likelihood found no join, the paper's rule stands in.
        let name = if interval.is_some() { "profile" } else { "paper" };
        Ok(((sections, rows), Some((chosen, name, table))))
    }
}
