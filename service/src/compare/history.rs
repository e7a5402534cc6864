//! How a value goes over the months: its drift by weighted least squares.

/// Days of a month.
///
/// Source: a twelfth of the mean year of the Gregorian calendar, 365.2425 days.
const MONTH_DAYS: f64 = 365.2425 / 12.0;

/// How fast a value changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drift {
    /// In a month, SI.
    pub per_month: f64,
    /// Its standard uncertainty, from those of the values.
    pub standard_uncertainty: f64,
}

/// The days from 1970-01-01 to a day, as `2026-11-21`; none if it is no day.
///
/// Source: H. Hinnant, "chrono-Compatible Low-Level Date Algorithms" (2013), `days_from_civil`.
#[must_use]
pub fn days(date: &str) -> Option<i64> {
    let mut parts = date.split('-').map(|part| part.parse::<i64>().ok());
    let (Some(Some(year)), Some(Some(month)), Some(Some(day)), None) =
        (parts.next(), parts.next(), parts.next(), parts.next())
    else {
        return None;
    };
    if !(1..=9999).contains(&year) || !(1..=12).contains(&month) || !(1..=31).contains(&day) {
        return None;
    }
    let year = if month <= 2 { year - 1 } else { year };
    let era = year.div_euclid(400);
    let of_era = year.rem_euclid(400);
    let of_year = (153 * ((month + 9) % 12) + 2) / 5 + day - 1;
    Some(era * 146_097 + of_era * 365 + of_era / 4 - of_era / 100 + of_year - 719_468)
}

/// The drift of values (day, value, standard uncertainty); none of values of one day, or of one that is known exactly.
#[must_use]
pub fn drift(points: &[(i64, f64, f64)]) -> Option<Drift> {
    let first = points.first()?.0;
    let weighted = points.iter().map(|&(day, value, uncertainty)| {
        ((day - first) as f64 / MONTH_DAYS, value, 1.0 / (uncertainty * uncertainty))
    });
    let weighted: Vec<(f64, f64, f64)> = weighted.collect();
    let sum = |of: &dyn Fn(&(f64, f64, f64)) -> f64| weighted.iter().map(of).sum::<f64>();
    let total = sum(&|point| point.2);
    let (month, value) = (sum(&|point| point.0 * point.2) / total, sum(&|point| point.1 * point.2) / total);
    let spread = sum(&|point| (point.0 - month).powi(2) * point.2);
    let together = sum(&|point| (point.0 - month) * (point.1 - value) * point.2);
    let drift = Drift { per_month: together / spread, standard_uncertainty: (1.0 / spread).sqrt() };
    (drift.per_month.is_finite() && spread > 0.0 && spread.is_finite()).then_some(drift)
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    /// Reference: `service/tests/compare/reference.py`.
    #[test]
    fn validate_against_an_independent_program() {
        let drift = drift(&[(0, 1.0, 0.2), (31, 1.6, 0.3), (59, 1.9, 0.2), (90, 3.1, 0.4)]).expect("a drift");
        assert_relative_eq!(drift.per_month, 0.579_270_971_798_367, max_relative = 1e-12);
        assert_relative_eq!(drift.standard_uncertainty, 0.120_218_186_649_119, max_relative = 1e-12);
    }

    #[test]
    fn days_are_those_of_the_calendar() {
        for (date, expected) in
            [("1970-01-01", 0), ("2000-02-29", 11_016), ("2026-11-27", 20_784), ("1969-12-31", -1)]
        {
            assert_eq!(days(date), Some(expected), "{date}");
        }
        for date in ["", "2026", "2026-13-01", "2026-01-32", "soon", "2026-11-27-1", "-1-1-1"] {
            assert_eq!(days(date), None, "{date}");
        }
    }

    #[test]
    fn one_day_has_no_drift() {
        assert_eq!(drift(&[(5, 1.0, 0.1), (5, 2.0, 0.1)]), None);
        assert_eq!(drift(&[(5, 1.0, 0.0), (9, 2.0, 0.1)]), None);
        assert_eq!(drift(&[]), None);
    }
}
