//! General tolerances in a proposal: ISO 2768, for what has no tolerance of its own.

use super::draft::Refused;
use super::faces::{Faces, Group, MAX_SINE_OF_AXES};
use super::legs::{legs, longer_side, within};
use super::text::{comment, decimal, quoted};
use std::str::FromStr;
use trueness_document::tolerance_class::{Table, radius};
use trueness_geom::feature::Nominal;
use trueness_geom::shape::{Kind, Shape};
use trueness_geom::space::{cross, dot, minus, norm};

/// Share of its whole area below which a cylinder is a rounding, without opposite points.
const MIN_WHOLE_CYLINDER_SHARE: f64 = 0.5;

/// General tolerances by their letters: `ISO2768-mK`.
#[derive(Clone, Debug, PartialEq)]
pub struct General {
    /// f, m, c or v of ISO 2768-1, for lengths and angles.
    pub dimensions: Option<char>,
    /// H, K or L of ISO 2768-2, for forms and attitudes.
    pub geometry: Option<char>,
}

/// Letters that are no general tolerance.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error(
    "there is no general tolerance \"{0}\"; write it as ISO2768-mK: f, m, c or v for lengths and angles, H, K or L for forms and attitudes, one or both"
)]
pub struct NoGeneral(String);

impl FromStr for General {
    type Err = NoGeneral;

    /// ```
    /// use trueness_measure::proposal::General;
    /// let both = General { dimensions: Some('m'), geometry: Some('K') };
    /// assert_eq!(["ISO2768-mK", "ISO 2768 - mK", "mK"].map(str::parse), [(); 3].map(|()| Ok(both.clone())));
    /// assert_eq!("f".parse(), Ok(General { dimensions: Some('f'), geometry: None }));
    /// assert!(["", "ISO2768", "mX", "Km", "H7"].iter().all(|text| text.parse::<General>().is_err()));
    /// ```
    fn from_str(text: &str) -> Result<General, NoGeneral> {
        let plain: String = text.chars().filter(|c| !c.is_whitespace()).collect();
        let letters = plain.strip_prefix("ISO2768-").unwrap_or(&plain);
        let (mut made, mut rest) = (General { dimensions: None, geometry: None }, letters.chars().peekable());
        made.dimensions = rest.next_if(|c| "fmcv".contains(*c));
        made.geometry = rest.next_if(|c| "HKL".contains(*c));
        match (rest.next(), &made) {
            (None, General { dimensions: None, geometry: None }) | (Some(_), _) => {
                Err(NoGeneral(text.into()))
            }
            (None, _) => Ok(made),
        }
    }
}

/// The name of the class on drawings.
fn name(general: &General) -> String {
    general.dimensions.iter().chain(&general.geometry).collect()
}

/// Limits of a radius as those of its diameter, by the class of lengths.
pub(super) fn of_radius(general: &General, own: f64) -> Result<[f64; 2], String> {
    let class = general.dimensions.ok_or("the general tolerances have none for lengths")?.to_string();
    radius(&class, own).map(|limits| limits.map(|x| 2.0 * x)).map_err(|e| e.to_string())
}

/// A feature with all that general tolerances go by.
struct Own {
    id: String,
    shape: Shape,
    nominal: Nominal,
    /// Whether a cylinder is a rounding.
    is_rounding: bool,
}

/// The characteristics of features by general tolerances: form, size, and place and attitude to other planes; angles and attitudes are those
/// to the feature "A", a plane.
pub(super) fn characteristics(
    general: &General,
    faces: &Faces,
    features: &[(String, Group)],
    refused: &Refused,
) -> String {
    let own = |(id, group): &(String, Group)| {
        let nominal = faces.nominal(group)?;
        let whole = nominal.area().unwrap_or(f64::INFINITY);
        let is_rounding =
            group.shape.kind() == Kind::Cylinder && faces.area(group) < MIN_WHOLE_CYLINDER_SHARE * whole;
        Some(Own { id: id.clone(), shape: group.shape, nominal, is_rounding })
    };
    let all: Vec<Own> = features.iter().filter_map(own).collect();
    let mut out = Out { general, refused, text: String::new(), number: 0 };
    let datum = all.iter().find(|own| own.id == "A");
    for (n, own) in all.iter().enumerate() {
        out.form(own);
        out.size(own);
        out.distance(own, &all[..n]);
        if let Some(datum) = datum.filter(|datum| datum.id != own.id) {
            out.attitude(own, datum);
        }
    }
    out.text
}

/// The text while it grows.
struct Out<'a> {
    general: &'a General,
    refused: &'a Refused,
    text: String,
    number: usize,
}

impl Out<'_> {
    /// Adds a characteristic, or the reason why there is none.
    fn add(&mut self, kind: &str, id: &str, lines: Result<String, String>) {
        self.number += 1;
        let number = self.number.to_string();
        let lines = match self.refused.get(&number) {
            Some(why) => Err(why.clone()),
            None => lines,
        };
        self.text.push('\n');
        self.text.push_str(&match lines {
            Ok(lines) => format!("[[characteristic]]\nid = \"{number}\"\nkind = \"{kind}\"\n{lines}"),
            Err(why) => {
                comment(&format!("Not in the plan: {kind} of \"{id}\" by {}: {why}", name(self.general)))
            }
        });
    }

    fn form(&mut self, own: &Own) {
        let (Some(class), Nominal::Plane { normal, boundary, .. }) = (self.general.geometry, &own.nominal)
        else {
            return;
        };
        let length = longer_side(boundary, *normal);
        let limits = Table::Form.limits(&class.to_string(), 0.0, Some(length));
        let lines = limits.map(|_| {
            format!("feature = {}\nclass = \"{class}\"\nlength = {}\n", quoted(&own.id), decimal(length))
        });
        self.add("flatness", &own.id, lines.map_err(|e| e.to_string()));
    }

    fn size(&mut self, own: &Own) {
        let Some(class) = self.general.dimensions else { return };
        let (Shape::Cylinder { radius, .. } | Shape::Sphere { radius, .. }) = own.shape else { return };
        let is_sphere = own.shape.kind() == Kind::Sphere;
        let size = if is_sphere || own.is_rounding { "GG" } else { "LP" };
        let head = format!(
            "feature = {}\nsize = \"{size}\"\nnominal = {}\n",
            quoted(&own.id),
            decimal(2.0 * radius)
        );
        let lines = match own.is_rounding {
            true => of_radius(self.general, radius).map(|[lower, upper]| {
                format!("{head}upper = {}\nlower = {}\n", decimal(upper), decimal(lower))
            }),
            false => {
                let limits = Table::Size.limits(&class.to_string(), 2.0 * radius, None);
                limits.map(|_| format!("{head}class = \"{class}\"\n")).map_err(|e| e.to_string())
            }
        };
        self.add("size", &own.id, lines);
    }

    /// Of a plane, from the first one that it is parallel to.
    fn distance(&mut self, own: &Own, before: &[Own]) {
        let (Some(class), Shape::Plane { point, normal }) = (self.general.dimensions, own.shape) else {
            return;
        };
        let from = before.iter().find_map(|first| match first.shape {
            Shape::Plane { point: p, normal: n } if norm(cross(normal, n)) < MAX_SINE_OF_AXES => {
                Some((&first.id, dot(minus(point, p), n).abs()))
            }
            _ => None,
        });
        let Some((from, nominal)) = from else { return };
        let limits = Table::Linear.limits(&class.to_string(), nominal, None);
        let lines = limits.map(|_| {
            let (own, from) = (quoted(&own.id), quoted(from));
            format!(
                "feature = {own}\ndatums = [{from}]\nnominal = {}\nclass = \"{class}\"\n",
                decimal(nominal)
            )
        });
        self.add("distance", &own.id, lines.map_err(|e| e.to_string()));
    }

    /// To the datum: perpendicular by its own table, inclined as an angle, parallel by the greater one of flatness and distance
    /// (ISO 2768-2, 5.2.1).
    fn attitude(&mut self, own: &Own, datum: &Own) {
        let (Some(way), Some(normal)) = (own.shape.direction(), datum.shape.direction()) else { return };
        let is_plane = own.shape.kind() == Kind::Plane;
        let sine = norm(cross(way, normal));
        let names = format!("feature = {}\ndatums = [{}]\n", quoted(&own.id), quoted(&datum.id));
        let is_along = sine < MAX_SINE_OF_AXES;
        let is_across = dot(way, normal).abs() < MAX_SINE_OF_AXES;
        if is_plane == is_across && (is_across || is_along) {
            let Some(class) = self.general.geometry else { return };
            let length = legs(&own.nominal, &datum.nominal);
            let limits = Table::Perpendicularity.limits(&class.to_string(), 0.0, Some(length));
            let lines = limits.map(|_| format!("{names}class = \"{class}\"\nlength = {}\n", decimal(length)));
            self.add("perpendicularity", &own.id, lines.map_err(|e| e.to_string()));
        } else if is_plane && is_along {
            self.parallelism(own, datum, &names);
        } else if is_plane {
            let Some(class) = self.general.dimensions else { return };
            let length = legs(&own.nominal, &datum.nominal);
            let nominal = libm::asin(sine.min(1.0)).to_degrees();
            let limits = Table::Angular.limits(&class.to_string(), nominal, Some(length));
            let lines = limits.map(|_| {
                format!(
                    "{names}nominal = {}\nclass = \"{class}\"\nlength = {}\n",
                    decimal(nominal),
                    decimal(length)
                )
            });
            self.add("angle", &own.id, lines.map_err(|e| e.to_string()));
        }
    }

    fn parallelism(&mut self, own: &Own, datum: &Own, names: &str) {
        let (Some(class), Nominal::Plane { point, normal, boundary }) = (self.general.geometry, &own.nominal)
        else {
            return;
        };
        let flat = Table::Form.limits(&class.to_string(), 0.0, Some(longer_side(boundary, *normal)));
        let off = within(&datum.nominal, *point).abs();
        let apart = self.general.dimensions.map(|class| Table::Linear.limits(&class.to_string(), off, None));
        let width = |limits: [f64; 2]| limits[1] - limits[0];
        let lines = flat.map(|flat| {
            let apart = apart.and_then(Result::ok).map_or(0.0, width);
            format!("{names}tolerance = {}\n", decimal(width(flat).max(apart)))
        });
        self.add("parallelism", &own.id, lines.map_err(|e| e.to_string()));
    }
}
