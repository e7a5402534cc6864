//! Which letter separates the cells of a table, seen from its header.

/// The separator that splits the header into most names; a comma if nothing does.
pub(super) fn guess_separator(head: &[u8], line_end: u8) -> u8 {
    let header = head
        .split(|&byte| byte == line_end)
        .find(|line| !line.starts_with(b"#") && line.iter().any(|byte| !byte.is_ascii_whitespace()))
        .unwrap_or_default();
    let count = |separator: u8| {
        let mut quoted = false;
        header
            .iter()
            .filter(|&&byte| {
                quoted ^= byte == b'"';
                byte == separator && !quoted
            })
            .count()
    };
    let most = [b',', b';', b'\t', b'|'].into_iter().max_by_key(|&separator| count(separator));
    match most {
        Some(separator) if count(separator) > 0 => separator,
        // A space also sets off a unit, so that it separates only where nothing else does.
        _ if count(b' ') > 0 && !header.contains(&b'[') && !header.contains(&b'(') => b' ',
        _ => b',',
    }
}
