//! Names of variables in FMI's structured naming.
//!
//! `body."lower arm".at[0][1] => body.'lower arm'.at[0,1]` (FMI 2.0.4, section 2.2.9). If a name has characters outside
//! that naming, all names remain unchanged and unstructured.

/// A name or path of a scene in structured form; `None` if impossible.
#[must_use]
pub fn structured(path: &str) -> Option<String> {
    let (mut all, mut rest) = (String::new(), path);
    loop {
        let name;
        (name, rest) = match rest.strip_prefix('"').and_then(|quoted| quoted.split_once('"')) {
            Some((name, rest)) => (name, rest),
            None => rest.split_at(rest.find(['.', '[']).unwrap_or(rest.len())),
        };
        all += &quoted(name)?;
        let mut entries = Vec::new();
        while let Some(entry) = rest.strip_prefix('[') {
            let (entry, after) = entry.split_once(']')?;
            entries.push(entry.parse::<usize>().ok()?.to_string());
            rest = after;
        }
        if !entries.is_empty() {
            all += &format!("[{}]", entries.join(","));
        }
        match rest.strip_prefix('.') {
            Some(after) => (all, rest) = (all + ".", after),
            None if rest.is_empty() => return Some(all),
            None => return None,
        }
    }
}

/// A part of a name, quoted if necessary.
fn quoted(name: &str) -> Option<String> {
    let is_letter = |letter: char| letter.is_ascii_alphabetic() || letter == '_';
    if name.starts_with(is_letter) && name.chars().all(|l| is_letter(l) || l.is_ascii_digit()) {
        return Some(name.to_owned());
    }
    if name.is_empty() || !name.chars().all(|letter| letter == ' ' || letter.is_ascii_graphic()) {
        return None;
    }
    // The naming does not allow a grave accent.
    (!name.contains('`')).then(|| {
        let escaped = name.replace('\\', "\\\\").replace('\'', "\\'").replace('"', "\\\"");
        format!("'{escaped}'")
    })
}

#[cfg(test)]
mod tests {
    use super::structured;

    #[test]
    fn what_is_no_identifier_is_quoted() {
        for (path, name) in [
            ("cart.x", "cart.x"),
            ("lower arm.qw", "'lower arm'.qw"),
            ("body.\"arm.left\".mass", "body.'arm.left'.mass"),
            ("gravity[1]", "gravity[1]"),
            ("tsda.1.points[0][2]", "tsda.'1'.points[0,2]"),
            ("it's.x", "'it\\'s'.x"),
        ] {
            assert_eq!(structured(path).as_deref(), Some(name));
        }
        for path in ["körper.x", "a..b", "", "a`.x", "a[x]", "a[0]b"] {
            assert_eq!(structured(path), None, "{path}");
        }
    }
}
