//! What the JSON documents have in common.

use serde::{Serialize, Serializer};

/// Values by name, an object in their order. Of equal names the last value stands, at the place of the first.
pub(super) struct Named<T>(Vec<(String, T)>);

impl<T> FromIterator<(String, T)> for Named<T> {
    fn from_iter<I: IntoIterator<Item = (String, T)>>(values: I) -> Self {
        let mut named: Vec<(String, T)> = Vec::new();
        for (name, value) in values {
            match named.iter_mut().find(|(known, _)| *known == name) {
                Some((_, known)) => *known = value,
                None => named.push((name, value)),
            }
        }
        Self(named)
    }
}

impl<T: Serialize> Serialize for Named<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

/// A document, laid out, with a newline at its end.
pub(super) fn document(value: &impl Serialize) -> String {
    // Names are strings and figures are numbers, so nothing here can fail.
    let mut text = serde_json::to_string_pretty(value).unwrap_or_default();
    text.push('\n');
    text
}
