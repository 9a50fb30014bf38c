//! `btc new`: a small project to begin with.

/// A file of a project: its path in the folder of the project, with `/` between its parts, and its text.
pub type File = (&'static str, &'static str);

/// The files of a new project: a small world that learns, what is to hold in it, and how to check both on each push.
pub const FILES: [File; 4] = [
    ("world.bt", include_str!("new/world.bt")),
    ("tests.bt", include_str!("new/tests.bt")),
    (".github/workflows/btc.yml", include_str!("new/ci.yml")),
    (".gitignore", "/learned/\n"),
];

/// What to do with a new project in a folder of this name, line by line.
pub fn welcome(name: &str) -> String {
    let steps = [
        ("btc run world.bt", "run the tree that a person wrote"),
        ("btc learn world.bt -o learned", "learn one"),
        (
            "btc test --no-learn tests.bt",
            "test the tree without its world",
        ),
        ("btc verify tests.bt", "test what is to hold in it"),
    ];
    let mut text =
        format!("{name}: world.bt, tests.bt, .github/workflows/btc.yml\n\n  cd {name}\n");
    for (command, does) in steps {
        text.push_str(&format!("  {command:<32} # {does}\n"));
    }
    text
}
