//! Tolerance classes of sizes: ISO 286-1:2010, tables 1, 4 and 5, for nominal sizes up to 500 mm.
//!
//! A class is a fundamental deviation (letters) and a standard tolerance grade (number). The tables hold the shafts' values
//! in micrometers as ISO 286-1 rounds them; those of holes follow by its rules: the mirrored value for D to
//! H, and for K to S the mirrored value and the difference Δ of the grade and the next finer one.
//!
//! Letters that are not here (a to c, cd, ef, fg, j of holes, t to zc) and sizes above 500 mm are refused.

use super::error::ClassError;

/// Upper ends of the nominal sizes, millimeters; a range is above the one before it, up to and including its end.
const ENDS: [f64; 13] = [3.0, 6.0, 10.0, 18.0, 30.0, 50.0, 80.0, 120.0, 180.0, 250.0, 315.0, 400.0, 500.0];

/// Standard tolerances IT1 to IT18, micrometers (ISO 286-1:2010, table 1).
const IT: [[f64; 13]; 18] = [
    [0.8, 1.0, 1.0, 1.2, 1.5, 1.5, 2.0, 2.5, 3.5, 4.5, 6.0, 7.0, 8.0],
    [1.2, 1.5, 1.5, 2.0, 2.5, 2.5, 3.0, 4.0, 5.0, 7.0, 8.0, 9.0, 10.0],
    [2.0, 2.5, 2.5, 3.0, 4.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 13.0, 15.0],
    [3.0, 4.0, 4.0, 5.0, 6.0, 7.0, 8.0, 10.0, 12.0, 14.0, 16.0, 18.0, 20.0],
    [4.0, 5.0, 6.0, 8.0, 9.0, 11.0, 13.0, 15.0, 18.0, 20.0, 23.0, 25.0, 27.0],
    [6.0, 8.0, 9.0, 11.0, 13.0, 16.0, 19.0, 22.0, 25.0, 29.0, 32.0, 36.0, 40.0],
    [10.0, 12.0, 15.0, 18.0, 21.0, 25.0, 30.0, 35.0, 40.0, 46.0, 52.0, 57.0, 63.0],
    [14.0, 18.0, 22.0, 27.0, 33.0, 39.0, 46.0, 54.0, 63.0, 72.0, 81.0, 89.0, 97.0],
    [25.0, 30.0, 36.0, 43.0, 52.0, 62.0, 74.0, 87.0, 100.0, 115.0, 130.0, 140.0, 155.0],
    [40.0, 48.0, 58.0, 70.0, 84.0, 100.0, 120.0, 140.0, 160.0, 185.0, 210.0, 230.0, 250.0],
    [60.0, 75.0, 90.0, 110.0, 130.0, 160.0, 190.0, 220.0, 250.0, 290.0, 320.0, 360.0, 400.0],
    [100.0, 120.0, 150.0, 180.0, 210.0, 250.0, 300.0, 350.0, 400.0, 460.0, 520.0, 570.0, 630.0],
    [140.0, 180.0, 220.0, 270.0, 330.0, 390.0, 460.0, 540.0, 630.0, 720.0, 810.0, 890.0, 970.0],
    [250.0, 300.0, 360.0, 430.0, 520.0, 620.0, 740.0, 870.0, 1000.0, 1150.0, 1300.0, 1400.0, 1550.0],
    [400.0, 480.0, 580.0, 700.0, 840.0, 1000.0, 1200.0, 1400.0, 1600.0, 1850.0, 2100.0, 2300.0, 2500.0],
    [600.0, 750.0, 900.0, 1100.0, 1300.0, 1600.0, 1900.0, 2200.0, 2500.0, 2900.0, 3200.0, 3600.0, 4000.0],
    [1000.0, 1200.0, 1500.0, 1800.0, 2100.0, 2500.0, 3000.0, 3500.0, 4000.0, 4600.0, 5200.0, 5700.0, 6300.0],
    [1400.0, 1800.0, 2200.0, 2700.0, 3300.0, 3900.0, 4600.0, 5400.0, 6300.0, 7200.0, 8100.0, 8900.0, 9700.0],
];

/// Magnitude of the upper deviation of shafts d to g, micrometers (ISO 286-1:2010, table 4).
const CLEAR: [(&str, [f64; 13]); 4] = [
    ("d", [20.0, 30.0, 40.0, 50.0, 65.0, 80.0, 100.0, 120.0, 145.0, 170.0, 190.0, 210.0, 230.0]),
    ("e", [14.0, 20.0, 25.0, 32.0, 40.0, 50.0, 60.0, 72.0, 85.0, 100.0, 110.0, 125.0, 135.0]),
    ("f", [6.0, 10.0, 13.0, 16.0, 20.0, 25.0, 30.0, 36.0, 43.0, 50.0, 56.0, 62.0, 68.0]),
    ("g", [2.0, 4.0, 5.0, 6.0, 7.0, 9.0, 10.0, 12.0, 14.0, 15.0, 17.0, 18.0, 20.0]),
];

/// Lower deviation of shafts k (IT4 to IT7) to p, micrometers (ISO 286-1:2010, table 5).
const TIGHT: [(&str, [f64; 13]); 4] = [
    ("k", [0.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0, 5.0]),
    ("m", [2.0, 4.0, 6.0, 7.0, 8.0, 9.0, 11.0, 13.0, 15.0, 17.0, 20.0, 21.0, 23.0]),
    ("n", [4.0, 8.0, 10.0, 12.0, 15.0, 17.0, 20.0, 23.0, 27.0, 31.0, 34.0, 37.0, 40.0]),
    ("p", [6.0, 12.0, 15.0, 18.0, 22.0, 26.0, 32.0, 37.0, 43.0, 50.0, 56.0, 62.0, 68.0]),
];

/// Upper ends of the finer ranges of r and s, millimeters.
const FINE_ENDS: [f64; 22] = [
    3.0, 6.0, 10.0, 18.0, 30.0, 50.0, 65.0, 80.0, 100.0, 120.0, 140.0, 160.0, 180.0, 200.0, 225.0, 250.0,
    280.0, 315.0, 355.0, 400.0, 450.0, 500.0,
];

/// Lower deviation of shafts r and s, micrometers (ISO 286-1:2010, table 5).
const TIGHTER: [(&str, [f64; 22]); 2] = [
    (
        "r",
        [
            10.0, 15.0, 19.0, 23.0, 28.0, 34.0, 41.0, 43.0, 51.0, 54.0, 63.0, 65.0, 68.0, 77.0, 80.0, 84.0,
            94.0, 98.0, 108.0, 114.0, 126.0, 132.0,
        ],
    ),
    (
        "s",
        [
            14.0, 19.0, 23.0, 28.0, 35.0, 43.0, 53.0, 59.0, 71.0, 79.0, 92.0, 100.0, 108.0, 122.0, 130.0,
            140.0, 158.0, 170.0, 190.0, 208.0, 232.0, 252.0,
        ],
    ),
];

/// Lower deviation of shafts j5 and j6, and of j7, micrometers (ISO 286-1:2010, table 4).
const J: [[f64; 13]; 2] = [
    [-2.0, -2.0, -2.0, -3.0, -4.0, -5.0, -7.0, -9.0, -11.0, -13.0, -16.0, -18.0, -20.0],
    [-4.0, -4.0, -5.0, -6.0, -8.0, -10.0, -12.0, -15.0, -18.0, -21.0, -26.0, -28.0, -32.0],
];

const KNOWN: &str = "d e f g h js j k m n p r s and D E F G H JS K M N P R S with a grade, as in H7; f, m, c, v of ISO 2768-1";

/// The place in a list of the value for a nominal size, where there is one.
fn range(ends: &[f64], nominal: f64) -> Option<usize> {
    ends.iter().position(|end| nominal <= *end).filter(|_| nominal > 0.0)
}

/// Lower and upper limit deviation in millimeters.
pub(super) fn limits(class: &str, nominal: f64) -> Result<[f64; 2], ClassError> {
    let digits = class.find(|c: char| c.is_ascii_digit()).unwrap_or(class.len());
    let (letters, number) = class.split_at(digits);
    let unknown = || ClassError::Unknown { class: class.into(), known: KNOWN };
    let grade: usize = number
        .parse()
        .ok()
        .filter(|g| (1..=18).contains(g) && !number.starts_with('0'))
        .ok_or_else(unknown)?;
    let out = || ClassError::Range { class: class.into(), length: nominal, range: "above 0 up to 500 mm" };
    let (at, fine) = (range(&ENDS, nominal).ok_or_else(out)?, range(&FINE_ENDS, nominal).ok_or_else(out)?);
    if grade > 13 && nominal <= 1.0 {
        return Err(ClassError::Grade {
            class: class.into(),
            letters: "a size up to 1 mm".into(),
            known: "grades 1 to 13",
        });
    }
    let lower = letters.to_lowercase();
    let hole = letters.chars().all(|c| c.is_ascii_uppercase());
    if letters.is_empty() || !(hole || letters == lower) {
        return Err(unknown());
    }
    let width = IT[grade - 1][at];
    let class = Class { text: class, letters: &lower, hole, grade, at, fine, width };
    let [from, to] = class.micrometers(nominal)?.ok_or_else(unknown)?;
    Ok([from / 1000.0, to / 1000.0])
}

/// A class with its places in the tables.
struct Class<'a> {
    text: &'a str,
    /// In lower case.
    letters: &'a str,
    hole: bool,
    grade: usize,
    at: usize,
    fine: usize,
    width: f64,
}

impl Class<'_> {
    /// Limits in micrometers; `None` for letters that are in no table.
    fn micrometers(&self, nominal: f64) -> Result<Option<[f64; 2]>, ClassError> {
        let (width, grade) = (self.width, self.grade);
        if self.letters == "js" {
            return Ok(Some([-0.5 * width, 0.5 * width]));
        }
        if self.letters == "h" {
            return Ok(Some(self.limits_from(0.0)));
        }
        if let Some((_, values)) = CLEAR.iter().find(|(l, _)| *l == self.letters) {
            return Ok(Some(self.limits_from(values[self.at])));
        }
        if self.letters == "j" {
            return match (self.hole, grade) {
                (false, 5 | 6) => Ok(Some([J[0][self.at], J[0][self.at] + width])),
                (false, 7) => Ok(Some([J[1][self.at], J[1][self.at] + width])),
                (false, _) => Err(self.refused("grades 5 to 7")),
                (true, _) => Ok(None),
            };
        }
        let tight = TIGHT.iter().find(|(l, _)| *l == self.letters).map(|(_, v)| v[self.at]);
        let tighter = TIGHTER.iter().find(|(l, _)| *l == self.letters).map(|(_, v)| v[self.fine]);
        let Some(value) = tight.or(tighter) else { return Ok(None) };
        match self.hole {
            true => self.tight_hole(value, nominal).map(Some),
            // k has its deviation in the grades 4 to 7 only.
            false if self.letters == "k" && !(4..=7).contains(&grade) => Ok(Some([0.0, width])),
            false => Ok(Some([value, value + width])),
        }
    }

    /// Limits that begin at this clearance.
    fn limits_from(&self, clearance: f64) -> [f64; 2] {
        match self.hole {
            true => [clearance, clearance + self.width],
            false => [-clearance - self.width, -clearance],
        }
    }

    /// Limits of the holes K to S whose shaft has this lower deviation.
    fn tight_hole(&self, value: f64, nominal: f64) -> Result<[f64; 2], ClassError> {
        let (grade, width) = (self.grade, self.width);
        let delta = match grade {
            // Up to 3 mm there is none.
            3.. if nominal > 3.0 => width - IT[grade - 2][self.at],
            _ => 0.0,
        };
        let upper = match self.letters {
            _ if grade < 3 => return Err(self.refused("grades from 3")),
            "k" | "m" if grade > 8 => return Err(self.refused("grades 3 to 8")),
            // The one value that the standard sets apart.
            "m" if grade == 6 && nominal > 250.0 && nominal <= 315.0 => -9.0,
            "n" if grade > 8 && nominal > 3.0 => 0.0,
            "k" | "m" | "n" if grade <= 8 => delta - value,
            "p" | "r" | "s" if grade <= 7 => delta - value,
            _ => -value,
        };
        Ok([upper - width, upper])
    }

    fn refused(&self, known: &'static str) -> ClassError {
        let letters = if self.hole { self.letters.to_uppercase() } else { self.letters.into() };
        ClassError::Grade { class: self.text.into(), letters, known }
    }
}
