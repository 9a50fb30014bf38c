//! Paths and the URIs that editors name them by.

use gen_lsp_types::Uri;
use std::fmt::Write;

/// The path that a URI names; the URI itself if it is of no file.
pub(super) fn path(uri: &Uri) -> String {
    let Some(rest) = uri.0.strip_prefix("file://") else {
        return uri.0.clone();
    };
    let path = decoded(rest.strip_prefix("localhost").unwrap_or(rest));
    // `/C:/robot.bt`
    match path.strip_prefix('/') {
        Some(inner) if inner.get(1..2) == Some(":") => inner.to_owned(),
        _ => path,
    }
}

/// The URI of a path.
pub(super) fn of(path: &str) -> Uri {
    if path.contains("://") || path.starts_with("untitled:") {
        return Uri(path.to_owned());
    }
    let mut uri = String::from("file://");
    if path.get(1..2) == Some(":") {
        uri.push('/');
    }
    for byte in path.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'-' | b'_' | b'.' | b'~' => {
                uri.push(char::from(byte));
            }
            // Writing to a string cannot fail.
            byte => drop(write!(uri, "%{byte:02X}")),
        }
    }
    Uri(uri)
}

/// A text without its `%20`s. Bytes that are no UTF-8 are replaced, so that such a path names no file.
fn decoded(text: &str) -> String {
    let mut bytes = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let code = rest.get(1..3).filter(|_| first == '%');
        match code.and_then(|code| u8::from_str_radix(code, 16).ok()) {
            Some(byte) => {
                bytes.push(byte);
                rest = rest.get(3..).unwrap_or_default();
            }
            None => {
                let (letter, after) = rest.split_at(first.len_utf8());
                bytes.extend(letter.bytes());
                rest = after;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::{of, path};

    #[test]
    fn paths_come_back() {
        for name in [
            "/home/a b/größe 50%.bt",
            "/x/😀.bt",
            "C:/robots/a.bt",
            "untitled:Untitled-1",
        ] {
            assert_eq!(path(&of(name)), name);
        }
        assert_eq!(path(&of("/a%20b").0.as_str().into()), "/a%20b");
        assert_eq!(path(&"file:///a%2".into()), "/a%2");
        assert_eq!(path(&"file:///a%ff%zz".into()), "/a\u{FFFD}%zz");
    }
}
