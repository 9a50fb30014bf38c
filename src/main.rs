//! btc
fn main() {
    let path = std::env::args().nth(1).unwrap_or_default();
    let text = std::fs::read_to_string(&path).unwrap_or_default();
    let file = btc::source::FileId(0);
    let (ast, d1) = btc::syntax::parse(file, &text);
    let lib = include_str!("library/std.bt");
    let (std_ast, d2) = btc::syntax::parse(btc::source::FileId(1), lib);
    let c = btc::check::check(&[btc::check::Input{ast:&std_ast,library:true}, btc::check::Input{ast:&ast,library:false}]);
    for d in d1.iter().chain(&d2).chain(&c.diagnostics) {
        let s = btc::source::Source::new("x", if d.span().file.0==0 {text.clone()} else {lib.to_string()});
        println!("{} {:?} {:?} {} {:?}", d.code, s.position(d.span().start), d.labels.iter().map(|l|&l.message).collect::<Vec<_>>(), d.message, d.help);
    }
    println!("{:#?}", c.program.trees);
    println!("{:#?}", c.program.behaviors.values().map(|b|&b.name).collect::<Vec<_>>());
}
