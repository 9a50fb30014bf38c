//! What the comparisons of a table are called.

use super::{Asks, Comparison, Kind, Valued};
use std::collections::BTreeSet;

impl Valued {
    /// A name for each comparison, none of them twice or taken: `x_at_most_3_5`, `location_is_kitchen`.
    pub fn names(&self, comparisons: &[Comparison], also_taken: &str) -> Vec<String> {
        let columns = self.columns.iter().map(|column| column.name.as_str());
        let taken = columns.chain(self.behaviors()).chain([also_taken]);
        let mut taken: BTreeSet<String> = taken.map(str::to_owned).collect();
        let names = comparisons.iter().map(|comparison| {
            let name = self.name(*comparison);
            let numbered = (2_usize..).map(|number| format!("{name}_{number}"));
            let mut names = std::iter::once(name.clone()).chain(numbered);
            let free = names.find(|name| !taken.contains(name)).unwrap_or(name);
            taken.insert(free.clone());
            free
        });
        names.collect()
    }

    fn name(&self, comparison: Comparison) -> String {
        let Some(column) = self.columns.get(comparison.column) else {
            return String::new();
        };
        let name = &column.name;
        match (comparison.asks, &column.kind) {
            (Asks::AtMost(last), _) => {
                let cut = self.cut(comparison.column, last);
                let cut = cut.map(|cut| cut.to_string()).unwrap_or_default();
                let cut = match cut.strip_prefix('-') {
                    Some(cut) => format!("minus_{cut}"),
                    None => cut,
                };
                format!("{name}_at_most_{}", cut.replace(['.', '-'], "_"))
            }
            (Asks::Is(code), Kind::Category(values)) => {
                let value = values.get(code as usize);
                format!("{name}_is_{}", value.map_or("", |value| value))
            }
            (Asks::Is(_), _) => name.clone(),
        }
    }
}
