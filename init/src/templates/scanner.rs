//! Three-axis scanners: alpha about z, beta about x, gamma about z again, with the line of sight along the last axis.

use super::{Beside, Template, has};
use crate::look::{Look, Read};
use crate::words::Part;
use crate::{Draft, Observed};

pub const TEMPLATE: Template = Template {
    name: "scanner",
    what: "a scanner with three axes, as of a mobile lidar",
    looks_for: "alpha, beta, gamma; x, y, z of a unit vector",
    fits: |look| has(look, &[Part::Alpha, Part::Beta, Part::Gamma]),
    draft,
};

/// The median of what is between the measured and the computed direction is less than this, in rad, in the right frame.
const NEAR_RAD: f64 = 0.35;

fn draft(look: &Look) -> Result<Draft, String> {
    let mut remarks = Vec::new();
    let joints = [
        look.needed(&[Part::Alpha], "the outer axis", "`alpha`")?,
        look.needed(&[Part::Beta], "the middle axis", "`beta`")?,
        look.needed(&[Part::Gamma], "the inner axis", "`gamma`")?,
    ];
    let joints = look.angles(&joints, &mut remarks)?;
    let observed = Observed::direction(
        look,
        [&[Part::Azimuth], &[Part::Elevation]],
        ["azimuth", "elevation"],
        &mut remarks,
    )?;
    if let Some(vectors) = observed.vectors() {
        follows(&joints, &vectors).ok_or_else(|| {
            format!(
                "{}: the directions do not follow Rz(alpha), Rx(beta) of z: write the chain of this scanner by hand, after \
                 examples/mobile-lidar/mobile-lidar.chain",
                look.file
            )
        })?;
    }
    let beside = Beside::of(look);
    let names = ["alpha", "beta", "gamma"].map(str::to_owned);
    Ok(Draft {
        chain: CHAIN.replace("STATEMENTS", &beside.statements),
        observable: "pointing",
        columns: names.into_iter().zip(joints).chain(beside.columns).collect(),
        observed,
        turned: None,
        estimate: Vec::new(),
        start: Vec::new(),
        tolerance: &[],
        inputs: beside.names,
        is_in_order: false,
        unfollowed: None,
        remarks,
    })
}

/// Whether directions are those of the chain without errors, nearly.
fn follows(joints: &[Read], vectors: &[[f64; 3]]) -> Option<()> {
    let [alpha, beta, ..] = joints else { return None };
    let mut between: Vec<f64> = alpha
        .si
        .iter()
        .zip(&beta.si)
        .zip(vectors)
        .map(|((a, b), v)| {
            let nominal = [a.sin() * b.sin(), -a.cos() * b.sin(), b.cos()];
            nominal.iter().zip(v).map(|(n, v)| (n - v).powi(2)).sum::<f64>().sqrt()
        })
        .collect();
    between.sort_by(f64::total_cmp);
    (*between.get(between.len() / 2)? < NEAR_RAD).then_some(())
}

const CHAIN: &str = "/// A scanner with three axes. z points up.
chain Scanner {
STATEMENTS    /// What turns about the outer axis.
    body outer on ground {
        position_error:
            /// Tilt of the outer axis about x.
            Rx(tilt_x),
            /// Tilt of the outer axis about y.
            Ry(tilt_y);
        motion: Rz(alpha);
        motion_error:
            /// Index error of the outer axis: true minus reading.
            Rz(alpha_index);
    }

    /// What turns about the middle axis.
    body middle on outer {
        position_error:
            /// Non-perpendicularity of the middle axis to the outer one.
            Ry(middle_axis);
        motion: Rx(beta);
        motion_error:
            /// Index error of the middle axis: true minus reading.
            Rx(beta_index);
    }

    /// What turns about the inner axis.
    body inner on middle {
        position_error:
            /// Non-perpendicularity of the inner axis to the middle one.
            Ry(inner_axis);
        motion: Rz(gamma);
    }

    /// What looks along the inner axis.
    body device on inner {
        position_error:
            /// The line of sight against the inner axis, about x.
            Rx(sight_x),
            /// The line of sight against the inner axis, about y.
            Ry(sight_y);
    }

    /// Where the line of sight points.
    observe pointing: direction(0, 0, 1) of device;
}
";
