//! Pictures of what an effect does to a line of sight, over the sky of an alt-azimuth mount.

use std::fmt::Write as _;

use effects::candidate::Effect;
use model_core::{Chain, SymbolKind, exact};
use observe::tangent_frame;

/// Half the width of a picture.
const HALF: f64 = 110.0;
/// The longest arrow.
const ARROW: f64 = 20.0;
/// The size that the effect is given.
const SMALL_RAD: f64 = 1e-4;

/// Arrows across and along at azimuths and elevations, north up, east to the right, the horizon as the rim, for one
/// function of an effect; inputs are one.
pub fn sky(effect: &Effect, function: usize, chain: &Chain, observable: &str) -> String {
    let (amended, errors) = effect.add_to(chain).unwrap();
    let id = amended.find_observable(observable).unwrap();
    let joints: Vec<_> = amended.symbols_of(SymbolKind::Joint).collect();
    let mut values = amended.nominal_values();
    for input in amended.symbols_of(SymbolKind::Input) {
        values[input.index()] = 1.0;
    }
    let mut arrows = Vec::new();
    for (ring, elevation_deg) in [(6, 75.0_f64), (12, 55.0), (18, 35.0), (24, 15.0)] {
        for step in 0..ring {
            let azimuth = std::f64::consts::TAU * f64::from(step) / f64::from(ring);
            values[joints[0].index()] = azimuth;
            values[joints[1].index()] = elevation_deg.to_radians();
            values[errors[function].index()] = 0.0;
            let aim = exact::value(&amended, id, &values);
            values[errors[function].index()] = SMALL_RAD;
            let moved = exact::value(&amended, id, &values) - aim;
            let [across, along] = tangent_frame(&aim).map(|axis| axis.dot(&moved) / SMALL_RAD);
            arrows.push((azimuth, elevation_deg, across, along));
        }
    }
    let longest = arrows.iter().map(|(_, _, x, y)| x.hypot(*y)).fold(0.0, f64::max).max(1e-12);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{0} {0} {1} {1}\" width=\"{1}\" height=\"{1}\">\n\
         <circle r=\"100\" fill=\"none\" stroke=\"#999\"/>\n<g stroke=\"#2563a8\" fill=\"#2563a8\">\n",
        -HALF,
        2.0 * HALF
    );
    for (azimuth, elevation_deg, across, along) in arrows {
        let radius = 100.0 * (1.0 - elevation_deg / 90.0);
        let (sine, cosine) = azimuth.sin_cos();
        let (x, y) = (radius * sine, -radius * cosine);
        // Across goes with the azimuth, along towards the zenith.
        let scale = ARROW / longest;
        let (dx, dy) = (scale * (across * cosine - along * sine), scale * (across * sine + along * cosine));
        let _ = writeln!(svg, "<circle cx=\"{x:.0}\" cy=\"{y:.0}\" r=\"1.5\" stroke=\"none\"/>");
        if dx.hypot(dy) >= 0.5 {
            let _ = writeln!(
                svg,
                "<line x1=\"{x:.0}\" y1=\"{y:.0}\" x2=\"{:.0}\" y2=\"{:.0}\"/>",
                x + dx,
                y + dy
            );
        }
    }
    svg.push_str("</g>\n</svg>\n");
    svg
}
