//! Times and sizes on the command line.

use jiff::civil::Date;
use jiff::tz::TimeZone;
use jiff::{Span, SpanRelativeTo, Timestamp, Unit};
use std::time::SystemTime;

/// Names of units of bytes, each with its number of bytes.
const UNITS: [(&str, f64); 7] = [
    ("B", 1.0),
    ("kB", 1e3),
    ("MB", 1e6),
    ("GB", 1e9),
    ("KiB", 1024.0),
    ("MiB", 1_048_576.0),
    ("GiB", 1_073_741_824.0),
];

/// Reads a moment in the past: an age such as `30d`, or the beginning of a day, UTC.
pub(in crate::cli) fn moment(text: &str) -> Result<SystemTime, String> {
    moment_before(Timestamp::now(), text).map(SystemTime::from)
}

fn moment_before(now: Timestamp, text: &str) -> Result<Timestamp, String> {
    let accepted = || {
        "accepted is an age in minutes, hours, days or weeks, such as 12h, 30d or 2w, or a date such as 2026-01-31 (UTC)"
            .to_owned()
    };
    if let Ok(date) = text.parse::<Date>() {
        let midnight = date.to_zoned(TimeZone::UTC).map_err(|_| accepted())?;
        return Ok(midnight.timestamp());
    }
    let age: Span = text.parse().map_err(|_| accepted())?;
    if age.is_negative() || age.get_months() != 0 || age.get_years() != 0 {
        return Err(accepted());
    }
    let days = SpanRelativeTo::days_are_24_hours();
    let seconds = age.total((Unit::Second, days)).map_err(|_| accepted())?;
    now.checked_sub(jiff::SignedDuration::from_secs_f64(seconds))
        .map_err(|_| accepted())
}

/// Reads a number of bytes such as `100MB`.
pub(in crate::cli) fn size(text: &str) -> Result<u64, String> {
    let digits = text.trim_end_matches(|letter: char| letter.is_ascii_alphabetic());
    let unit = &text[digits.len()..];
    let unit = UNITS
        .iter()
        .find(|(name, _)| name.eq_ignore_ascii_case(unit));
    let number = digits.trim().parse::<f64>().ok();
    let bytes = unit.zip(number).map(|((_, bytes), number)| number * bytes);
    match bytes.filter(|bytes| bytes.is_finite() && *bytes >= 0.0) {
        Some(bytes) => Ok(bytes as u64),
        None => {
            Err("accepted is a number of B, kB, MB, GB, KiB, MiB or GiB, such as 100MB".to_owned())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ages_and_dates_are_moments() {
        let now: Timestamp = "2026-03-01T12:00:00Z".parse().unwrap();
        let before = |text| moment_before(now, text).map(|moment| moment.to_string());
        assert_eq!(before("30d").unwrap(), "2026-01-30T12:00:00Z");
        assert_eq!(before("2w").unwrap(), "2026-02-15T12:00:00Z");
        assert_eq!(before("36h").unwrap(), "2026-02-28T00:00:00Z");
        assert_eq!(before("2026-01-31").unwrap(), "2026-01-31T00:00:00Z");
        for wrong in ["30", "1mo", "-3d", "a while", "", "2026-02-30", "99999999w"] {
            assert!(
                before(wrong).unwrap_err().contains("such as 12h"),
                "{wrong}"
            );
        }
    }

    #[test]
    fn sizes_have_units() {
        assert_eq!(size("100MB"), Ok(100_000_000));
        assert_eq!(size("1.5 GB"), Ok(1_500_000_000));
        assert_eq!(size("2KiB"), Ok(2048));
        assert_eq!(size("0B"), Ok(0));
        for wrong in ["100", "MB", "-1MB", "1e999GB", "ten MB", ""] {
            assert!(
                size(wrong).unwrap_err().contains("such as 100MB"),
                "{wrong}"
            );
        }
    }
}
