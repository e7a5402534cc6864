//! Names as people write them: patterns over declared names, and the nearest name to a misspelt one.
//!
//! Errors files, claims and study files share these, so that a pattern means the same everywhere.

/// The candidate nearest to a name that is none of them, if one is near enough to have been meant.
///
/// Near means: at most a third of the letters (and at least one) are changed, added, left out or swapped with
/// their neighbour, upper and lower case counting as equal. The first of equally near candidates is returned.
#[must_use]
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let wanted: Vec<char> = name.to_lowercase().chars().collect();
    let allowed = (wanted.len() / 3).max(1);
    let mut best: Option<(usize, &str)> = None;
    for candidate in candidates {
        let letters: Vec<char> = candidate.to_lowercase().chars().collect();
        let distance = edit_distance(&wanted, &letters);
        if distance <= allowed && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// How many letters must be changed, added, left out or swapped with their neighbour.
///
/// Source: the "optimal string alignment" variant of Damerau and Levenshtein's distance.
fn edit_distance(a: &[char], b: &[char]) -> usize {
    let mut before_last = vec![0; b.len() + 1];
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.iter().enumerate() {
        let mut row = vec![i + 1; b.len() + 1];
        for (j, y) in b.iter().enumerate() {
            let changed = last[j] + usize::from(x != y);
            row[j + 1] = changed.min(last[j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && *x == b[j - 1] && a[i - 1] == *y {
                row[j + 1] = row[j + 1].min(before_last[j - 1] + 1);
            }
        }
        before_last = std::mem::replace(&mut last, row);
    }
    last[b.len()]
}

/// Whether a text is a pattern rather than a plain name: whether it has a `*` in it.
#[must_use]
pub fn is_pattern(text: &str) -> bool {
    text.contains('*')
}

/// Whether a pattern matches a name; `*` stands for any letters, none included.
#[must_use]
pub fn matches(pattern: &str, name: &str) -> bool {
    let mut pieces = pattern.split('*');
    let first = pieces.next().unwrap_or_default();
    let Some(mut rest) = name.strip_prefix(first) else {
        return false;
    };
    let Some(last) = pieces.next_back() else {
        return rest.is_empty();
    };
    for piece in pieces {
        match rest.find(piece) {
            Some(at) => rest = &rest[at + piece.len()..],
            None => return false,
        }
    }
    rest.ends_with(last)
}

/// Names in backquotes, separated by commas.
#[must_use]
pub fn listed<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_star_stands_for_any_letters() {
        for (pattern, name) in [
            ("*", "dg2"),
            ("da*", "da1"),
            ("*3", "da3"),
            ("d*_y*", "dtheta_y1"),
            ("dg2", "dg2"),
            ("a*a", "aa"),
        ] {
            assert!(matches(pattern, name), "{pattern} matches {name}");
        }
        for (pattern, name) in [("da*", "db1"), ("dg2", "dg21"), ("a*a", "a"), ("", "dg2"), ("*x*", "dg2")] {
            assert!(!matches(pattern, name), "{pattern} does not match {name}");
        }
    }

    #[test]
    fn the_nearest_name_is_found_and_a_far_one_is_not() {
        let names = ["dtheta_y1", "dtheta_x1", "dg2", "delta_x2"];
        assert_eq!(nearest("dtheta_y", names), Some("dtheta_y1"));
        assert_eq!(nearest("dhteta_x1", names), Some("dtheta_x1"));
        assert_eq!(nearest("DG2", names), Some("dg2"));
        assert_eq!(nearest("temperature", names), None);
    }
}
