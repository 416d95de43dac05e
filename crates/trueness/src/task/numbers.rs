//! The numbers that options take.

use super::TaskError;

/// `x`, the value of the option `name`, if it is finite and not below 0.
///
/// # Errors
/// Wrong usage.
pub fn not_negative(name: &str, x: f64) -> Result<f64, TaskError> {
    checked(name, x, x.is_finite() && x >= 0.0, "a number from 0 upwards")
}

/// `x`, the value of the option `name`, if it is finite and above 0.
///
/// # Errors
/// Wrong usage.
pub fn above_zero(name: &str, x: f64) -> Result<f64, TaskError> {
    checked(name, x, x.is_finite() && x > 0.0, "a length above 0")
}

/// `x`, the value of the option `name`, if it is from 0 to 100 percent; as a share.
///
/// # Errors
/// Wrong usage.
pub fn share_of_percent(name: &str, x: f64) -> Result<f64, TaskError> {
    Ok(up_to(100.0, "percent", name, x)? / 100.0)
}

/// `x`, the value of the option `name`, if it is from 0 to `most` units of this name.
///
/// # Errors
/// Wrong usage.
pub fn up_to(most: f64, unit: &str, name: &str, x: f64) -> Result<f64, TaskError> {
    checked(name, x, (0.0..=most).contains(&x), &format!("a number from 0 to {most} {unit}"))
}

fn checked(name: &str, x: f64, is_allowed: bool, range: &str) -> Result<f64, TaskError> {
    match is_allowed {
        true => Ok(x),
        false => Err(TaskError::option(format!("{name} {x}: give {range}"))),
    }
}
