//! The chains under test, and one way to ask all of them.
#![allow(clippy::unwrap_used)]

use trueaxis::model_core::{Chain, ObservableId, SymbolKind};
use trueaxis::nalgebra::{Matrix3xX, Vector3};

trueaxis::chain_file!("tests/chains/turntable.chain");
trueaxis::chain_file!("examples/alt-azimuth/alt-azimuth.chain");
trueaxis::chain_file!("examples/mobile-lidar/mobile-lidar.chain");
trueaxis::chain_file!("examples/six-joint-arm/six-joint-arm.chain");
trueaxis::chain_file!("tests/chains/gantry.chain");
trueaxis::chain_file!("tests/chains/binocular.chain");
trueaxis::chain_file!("tests/chains/encoder.chain");
trueaxis::chain_file!("tests/chains/thermal.chain");
trueaxis::chain_file!("codegen/tests/chains/ramps.chain");

/// What the module of a chain says of one observable at one pose.
pub struct Answers {
    pub value: Vector3<f64>,
    pub error: Vector3<f64>,
    pub first_order: Vector3<f64>,
    pub jacobian: Matrix3xX<f64>,
}

/// One observable of one chain.
pub struct Case {
    pub file: &'static str,
    pub observable: &'static str,
    /// Answers by the values of all errors, and of all joints and then inputs.
    pub answer: fn(&[f64], &[f64]) -> Answers,
}

impl Case {
    /// The chain as `model-core` reads it, and the observable in it.
    pub fn chain(&self) -> (Chain, ObservableId) {
        let path = format!("{}/{}", env!("CARGO_MANIFEST_DIR"), self.file);
        let chain = Chain::from_text(&std::fs::read_to_string(path).unwrap()).unwrap();
        let observable = chain.find_observable(self.observable).unwrap();
        (chain, observable)
    }
}

/// How many symbols of some kinds a chain has.
pub fn count(chain: &Chain, kinds: &[SymbolKind]) -> usize {
    kinds.iter().map(|&kind| chain.symbols_of(kind).count()).sum()
}

/// The first `N` of some numbers, which are then gone.
fn take<const N: usize>(numbers: &mut &[f64]) -> [f64; N] {
    let (first, rest) = numbers.split_first_chunk().unwrap();
    *numbers = rest;
    *first
}

macro_rules! case {
    ($file:literal, $module:ident::$chain:ident($($pose:ident),+), $value:ident $error:ident $first:ident $jacobian:ident) => {
        Case {
            file: $file,
            observable: stringify!($value),
            answer: |mut errors, mut pose| {
                let instrument = $module::$chain::new(take(&mut errors).into());
                // Tuples are evaluated from left to right, so that joints are taken before inputs.
                let pose = ($($module::$pose::from(take(&mut pose)),)+);
                case!(@answers instrument, pose, $value $error $first $jacobian, $($pose)+)
            },
        }
    };
    (@answers $instrument:ident, $pose:ident, $value:ident $error:ident $first:ident $jacobian:ident, Joints) => {
        case!(@ask $instrument, $value $error $first $jacobian, (&$pose.0))
    };
    (@answers $instrument:ident, $pose:ident, $value:ident $error:ident $first:ident $jacobian:ident, Joints Inputs) => {
        case!(@ask $instrument, $value $error $first $jacobian, (&$pose.0, &$pose.1))
    };
    (@ask $instrument:ident, $value:ident $error:ident $first:ident $jacobian:ident, $arguments:tt) => {{
        let jacobian = $instrument.$jacobian $arguments;
        Answers {
            value: $instrument.$value $arguments,
            error: $instrument.$error $arguments,
            first_order: $instrument.$first $arguments,
            jacobian: Matrix3xX::from_column_slice(jacobian.as_slice()),
        }
    }};
}

/// Every observable of every chain.
#[rustfmt::skip]
pub const CASES: [Case; 18] = [
    case!("tests/chains/turntable.chain", turntable::Turntable(Joints), edge edge_error edge_first_order edge_jacobian),
    case!("tests/chains/turntable.chain", turntable::Turntable(Joints), corner corner_error corner_first_order corner_jacobian),
    case!("examples/alt-azimuth/alt-azimuth.chain", alt_azimuth::AltAzimuth(Joints), sight sight_error sight_first_order sight_jacobian),
    case!("examples/mobile-lidar/mobile-lidar.chain", mobile_lidar::MobileLidar(Joints), pointing pointing_error pointing_first_order pointing_jacobian),
    case!("examples/mobile-lidar/mobile-lidar.chain", mobile_lidar::MobileLidar(Joints), position position_error position_first_order position_jacobian),
    case!("examples/mobile-lidar/mobile-lidar.chain", mobile_lidar::MobileLidar(Joints, Inputs), target target_error target_first_order target_jacobian),
    case!("examples/six-joint-arm/six-joint-arm.chain", six_joint_arm::SixJointArm(Joints), tip tip_error tip_first_order tip_jacobian),
    case!("examples/six-joint-arm/six-joint-arm.chain", six_joint_arm::SixJointArm(Joints), tool tool_error tool_first_order tool_jacobian),
    case!("tests/chains/gantry.chain", gantry::Gantry(Joints), tip tip_error tip_first_order tip_jacobian),
    case!("tests/chains/gantry.chain", gantry::Gantry(Joints), axis axis_error axis_first_order axis_jacobian),
    case!("tests/chains/binocular.chain", binocular::Binocular(Joints), left_sight left_sight_error left_sight_first_order left_sight_jacobian),
    case!("tests/chains/binocular.chain", binocular::Binocular(Joints), right_lens right_lens_error right_lens_first_order right_lens_jacobian),
    case!("tests/chains/encoder.chain", encoder::Encoder(Joints), beam beam_error beam_first_order beam_jacobian),
    case!("tests/chains/encoder.chain", encoder::Encoder(Joints), prism prism_error prism_first_order prism_jacobian),
    case!("tests/chains/thermal.chain", thermal::Thermal(Joints, Inputs), spot spot_error spot_first_order spot_jacobian),
    case!("tests/chains/thermal.chain", thermal::Thermal(Joints, Inputs), line line_error line_first_order line_jacobian),
    case!("codegen/tests/chains/ramps.chain", ramps::Ramps(Joints), axis axis_error axis_first_order axis_jacobian),
    case!("codegen/tests/chains/ramps.chain", ramps::Ramps(Joints, Inputs), focus focus_error focus_first_order focus_jacobian),
];

/// Numbers from −1 to 1 that a seed decides.
pub fn numbers(seed: u64) -> impl Iterator<Item = f64> {
    let mut random = testkit::Random::new(seed);
    std::iter::repeat_with(move || 2.0 * random.even() - 1.0).skip(8)
}
