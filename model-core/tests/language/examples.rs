//! The chains in `examples/` mean what their papers and data sheets say.
#![allow(clippy::unwrap_used)]

use model_core::{Chain, Quantity, SymbolKind};

fn example(path: &str) -> Chain {
    let file = format!("{}/../examples/{path}", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&file).unwrap();
    Chain::from_text(&text).unwrap_or_else(|mistakes| panic!("{}", mistakes.render(path, &text)))
}

#[test]
fn the_mobile_lidar_has_the_thirty_errors_of_its_paper() {
    let chain = example("mobile-lidar/mobile-lidar.chain");
    assert_eq!(chain.name, "MobileLidar");
    let errors: Vec<&str> =
        chain.symbols_of(SymbolKind::Error).map(|id| chain.symbol(id).name.as_str()).collect();
    assert_eq!(
        errors.join(" "),
        "dtheta_y1 dtheta_x1 dx1 dy1 dz1 da1 db1 delta_x2 delta_y2 dtheta_y2 dtheta_z2 dx2 dy2 dz2 db2 dg2 \
         delta_y3 dtheta_y3 dtheta_x3 dx3 dy3 dz3 da3 db3 dx4 dy4 dz4 da4 db4 dg4"
    );
    let angles =
        chain.symbols_of(SymbolKind::Error).filter(|&id| chain.symbol(id).quantity == Quantity::Angle);
    assert_eq!(angles.count(), 15);
    let joints: Vec<&str> =
        chain.symbols_of(SymbolKind::Joint).map(|id| chain.symbol(id).name.as_str()).collect();
    assert_eq!(joints, ["alpha", "beta", "gamma"]);
    for symbol in chain.symbols_of(SymbolKind::Error).map(|id| chain.symbol(id)) {
        assert!(!symbol.documentation.is_empty(), "{} is documented", symbol.name);
    }
}

#[test]
fn the_alt_azimuth_mount_has_six_errors() {
    let chain = example("alt-azimuth/alt-azimuth.chain");
    assert_eq!(chain.symbols_of(SymbolKind::Error).count(), 6);
    assert!(chain.symbols_of(SymbolKind::Error).all(|id| chain.symbol(id).quantity == Quantity::Angle));
    assert_eq!(chain.observables.len(), 1);
}
