//! Colours and type, in a light and a dark scheme.

use std::fmt::Write;

/// The looks of a class: its declarations, and those that the dark scheme changes.
#[derive(Clone, Copy)]
pub(super) struct Rule {
    pub(super) class: &'static str,
    pub(super) light: &'static str,
    pub(super) dark: &'static str,
}

/// A rule.
pub(super) const fn rule(class: &'static str, light: &'static str, dark: &'static str) -> Rule {
    Rule { class, light, dark }
}

/// The width of a character of a name in px: fixed-width fonts are 0.6 em wide.
pub(super) const CELL: f64 = 7.2;

/// What all pictures share: the page, names as the program writes them, and remarks.
const SHARED: &[Rule] = &[
    rule("page", "fill:#ffffff", "fill:#0d1117"),
    rule(
        "name",
        "font:12px ui-monospace,SFMono-Regular,Menlo,Consolas,'DejaVu Sans Mono',monospace;fill:#1f2933",
        "fill:#e6edf3",
    ),
    rule(
        "remark",
        "font:11px system-ui,'Segoe UI',Helvetica,Arial,sans-serif;fill:#5b6770",
        "fill:#9aa7b2",
    ),
    rule("middle", "text-anchor:middle", ""),
    rule("end", "text-anchor:end", ""),
];

/// How many colours there are.
pub(super) const HUES: usize = 8;

/// The colours of Okabe and Ito (2008), which people with any colour vision tell apart; the eighth is the ink of the
/// page. Those that read well on both schemes come first; yellow is darker on white, and blue lighter on black, than
/// theirs.
pub(super) const LINES: [Rule; HUES] = [
    rule("line0", "stroke:#0072b2", "stroke:#2b9be0"),
    rule("line1", "stroke:#d55e00", ""),
    rule("line2", "stroke:#009e73", ""),
    rule("line3", "stroke:#cc79a7", ""),
    rule("line4", "stroke:#e69f00", ""),
    rule("line5", "stroke:#56b4e9", ""),
    rule("line6", "stroke:#b8ab00", "stroke:#f0e442"),
    rule("line7", "stroke:#000000", "stroke:#ffffff"),
];

/// The style sheet of a picture whose root has this class.
pub(super) fn sheet(root: &str, rules: &[Rule]) -> String {
    let all = || SHARED.iter().chain(rules);
    let mut text = String::from("\n");
    // Writing to a string does not fail.
    for Rule { class, light, .. } in all().filter(|rule| !rule.light.is_empty()) {
        let _ = writeln!(text, "    .{root} .{class} {{ {light} }}");
    }
    text.push_str("    @media (prefers-color-scheme: dark) {\n");
    for Rule { class, dark, .. } in all().filter(|rule| !rule.dark.is_empty()) {
        let _ = writeln!(text, "      .{root} .{class} {{ {dark} }}");
    }
    text.push_str("    }\n  ");
    text
}
