//! The expansion of `thermal.chain`, for `cargo clippy`: written by the tests of `model-macros`
//! with `UPDATE_EXPANDED=1`.

/// Inputs: temperature, range and the direction of motion act on a pan and tilt head.
#[allow(
    dead_code,
    non_camel_case_types,
    non_snake_case,
    non_upper_case_globals,
    unused_imports,
    unused_mut,
    unused_variables,
    clippy::default_trait_access,
    clippy::doc_markdown,
    clippy::large_types_passed_by_value,
    clippy::many_single_char_names,
    clippy::needless_range_loop,
    clippy::possible_missing_comma,
    clippy::similar_names,
    clippy::struct_field_names,
    clippy::suboptimal_flops,
    clippy::too_many_lines,
    clippy::trivially_copy_pass_by_ref,
    clippy::unreadable_literal,
    clippy::unused_self
)]
pub mod thermal {
    use ::trueaxis::__private::{ComplexField, Matrix3, SMatrix, Vector3};
    /// Inputs: temperature, range and the direction of motion act on a pan and tilt head.
    ///
    /// Angles are radians, lengths metres. `Default` is the instrument as designed.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    pub struct Thermal {
        /// What differs from the design.
        pub errors: Errors,
        /// The sizes of the geometry.
        pub constants: Constants,
    }
    impl Thermal {
        /// The declared name.
        pub const NAME: &'static str = "Thermal";
        /// The names of the joints, in order.
        pub const JOINT_NAMES: [&'static str; 2] = ["pan", "tilt"];
        /// The printed forms of the joints, in LaTeX, in order.
        pub const JOINT_LATEX: [&'static str; 2] = ["\\mathrm{pan}", "\\mathrm{tilt}"];
        /// The names of the inputs, in order.
        pub const INPUT_NAMES: [&'static str; 3] = ["temperature", "range", "reversal"];
        /// The printed forms of the inputs, in LaTeX, in order.
        pub const INPUT_LATEX: [&'static str; 3] = [
            "\\mathrm{temperature}",
            "\\mathrm{range}",
            "\\mathrm{reversal}",
        ];
        /// The names of the errors, in order.
        pub const ERROR_NAMES: [&'static str; 6] = [
            "backlash",
            "drift",
            "growth",
            "bend",
            "sag",
            "lean",
        ];
        /// The printed forms of the errors, in LaTeX, in order.
        pub const ERROR_LATEX: [&'static str; 6] = [
            "\\mathrm{backlash}",
            "\\mathrm{drift}",
            "\\mathrm{growth}",
            "\\mathrm{bend}",
            "\\mathrm{sag}",
            "\\mathrm{lean}",
        ];
        /// The names of the constants, in order.
        pub const CONSTANT_NAMES: [&'static str; 1] = ["column"];
        /// The printed forms of the constants, in LaTeX, in order.
        pub const CONSTANT_LATEX: [&'static str; 1] = ["\\mathrm{column}"];
        /// The instrument with these errors, and everything else as declared.
        #[must_use]
        pub fn new(errors: Errors) -> Self {
            Self {
                errors,
                constants: Constants::default(),
            }
        }
        /// The first-order error of `spot` as text: x, y and z.
        pub const SPOT_FIRST_ORDER: [&'static str; 3] = [
            "-0.01*temperature^2*range*bend*sin(pan)*sin(tilt) - temperature*range*lean*cos(pan)*sin(tilt) - (temperature*range*drift + range*reversal*backlash)*sin(pan)*cos(tilt) - 1/2*range*sag*cos(pan)*sin(2*tilt)",
            "0.01*temperature^2*range*bend*cos(pan)*sin(tilt) + (temperature*range*drift + range*reversal*backlash)*cos(pan)*cos(tilt) - temperature*range*lean*sin(pan)*sin(tilt) - 1/2*range*sag*sin(pan)*sin(2*tilt)",
            "-temperature*range*lean*cos(tilt) + temperature*growth*column - range*sag*cos(tilt)^2",
        ];
        /// The first-order error of `spot` in LaTeX: x, y and z.
        pub const SPOT_FIRST_ORDER_LATEX: [&'static str; 3] = [
            "-0.01 \\mathrm{temperature}^{2} \\mathrm{range} \\mathrm{bend} \\sin \\mathrm{pan} \\sin \\mathrm{tilt} - \\mathrm{temperature} \\mathrm{range} \\mathrm{lean} \\cos \\mathrm{pan} \\sin \\mathrm{tilt} - \\left(\\mathrm{temperature} \\mathrm{range} \\mathrm{drift} + \\mathrm{range} \\mathrm{reversal} \\mathrm{backlash}\\right) \\sin \\mathrm{pan} \\cos \\mathrm{tilt} - \\frac{1}{2} \\mathrm{range} \\mathrm{sag} \\cos \\mathrm{pan} \\sin 2 \\mathrm{tilt}",
            "0.01 \\mathrm{temperature}^{2} \\mathrm{range} \\mathrm{bend} \\cos \\mathrm{pan} \\sin \\mathrm{tilt} + \\left(\\mathrm{temperature} \\mathrm{range} \\mathrm{drift} + \\mathrm{range} \\mathrm{reversal} \\mathrm{backlash}\\right) \\cos \\mathrm{pan} \\cos \\mathrm{tilt} - \\mathrm{temperature} \\mathrm{range} \\mathrm{lean} \\sin \\mathrm{pan} \\sin \\mathrm{tilt} - \\frac{1}{2} \\mathrm{range} \\mathrm{sag} \\sin \\mathrm{pan} \\sin 2 \\mathrm{tilt}",
            "-\\mathrm{temperature} \\mathrm{range} \\mathrm{lean} \\cos \\mathrm{tilt} + \\mathrm{temperature} \\mathrm{growth} \\mathrm{column} - \\mathrm{range} \\mathrm{sag} \\cos^{2} \\mathrm{tilt}",
        ];
        /// The observable `spot`.
        ///
        /// With its errors, in the ground frame: a point, in metres.
        #[must_use]
        pub fn spot(&self, joints: &Joints, inputs: &Inputs) -> Vector3<f64> {
            let (nominal, difference) = self.spot_parts(joints, inputs);
            nominal + difference
        }
        /// What the errors add to [`spot`](Self::spot), exactly.
        ///
        /// In the ground frame, with full relative precision however small the errors are.
        #[must_use]
        pub fn spot_error(&self, joints: &Joints, inputs: &Inputs) -> Vector3<f64> {
            self.spot_parts(joints, inputs).1
        }
        /// [`spot`](Self::spot) without errors, and what they add.
        fn spot_parts(
            &self,
            joints: &Joints,
            inputs: &Inputs,
        ) -> (Vector3<f64>, Vector3<f64>) {
            let p: [f64; 7] = {
                let errors = &self.errors;
                let constants = &self.constants;
                [
                    errors.lean,
                    errors.sag,
                    0.01 * errors.bend,
                    constants.column,
                    errors.growth * constants.column,
                    errors.drift,
                    errors.backlash,
                ]
            };
            let (sin_tilt, cos_tilt) = ComplexField::sin_cos(joints.tilt);
            let (sin_pan, cos_pan) = ComplexField::sin_cos(joints.pan);
            let mut nominal = Vector3::new(inputs.range, 0.0, 0.0);
            let mut difference = Vector3::new(0.0, 0.0, 0.0);
            difference
                += departure_y(inputs.temperature * p[0] + p[1] * cos_tilt)
                    * (nominal + difference);
            let rotation = rotation_y(sin_tilt, cos_tilt);
            (nominal, difference) = (rotation * nominal, rotation * difference);
            difference
                += departure_x(inputs.temperature * inputs.temperature * p[2])
                    * (nominal + difference);
            difference.z += inputs.temperature * p[4];
            nominal.z += p[3];
            difference
                += departure_z(inputs.temperature * p[5] + inputs.reversal * p[6])
                    * (nominal + difference);
            let rotation = rotation_z(sin_pan, cos_pan);
            (nominal, difference) = (rotation * nominal, rotation * difference);
            (nominal, difference)
        }
        /// [`spot_error`](Self::spot_error) of many poses.
        ///
        /// `out` receives x, y and z.
        ///
        /// # Errors
        ///
        /// If the slices have different lengths.
        pub fn spot_error_rows(
            &self,
            joints: &JointRows<'_>,
            inputs: &InputRows<'_>,
            out: [&mut [f64]; 3],
        ) -> Result<(), LengthsDiffer> {
            fill(
                out,
                |rows| joints.have_length(rows) && inputs.have_length(rows),
                |row| self.spot_error(&joints.at(row), &inputs.at(row)).into(),
            )
        }
        /// What the errors add to [`spot`](Self::spot), to first order.
        ///
        /// Products of two or more errors are dropped.
        #[must_use]
        pub fn spot_first_order(
            &self,
            joints: &Joints,
            inputs: &Inputs,
        ) -> Vector3<f64> {
            Self::spot_first_order_at(&self.spot_first_order_prepared(), joints, inputs)
                .into()
        }
        /// What of [`spot_first_order`](Self::spot_first_order) no pose changes.
        fn spot_first_order_prepared(&self) -> [f64; 6] {
            let errors = &self.errors;
            let constants = &self.constants;
            [
                0.01 * errors.bend,
                errors.drift,
                errors.backlash,
                constants.column * errors.growth,
                errors.lean,
                errors.sag,
            ]
        }
        /// The rest of [`spot_first_order`](Self::spot_first_order), for one pose.
        fn spot_first_order_at(
            p: &[f64; 6],
            joints: &Joints,
            inputs: &Inputs,
        ) -> [f64; 3] {
            let (sin_pan, cos_pan) = ComplexField::sin_cos(joints.pan);
            let (sin_tilt, cos_tilt) = ComplexField::sin_cos(joints.tilt);
            let t26 = cos_tilt * (inputs.temperature * p[1] + inputs.reversal * p[2])
                + sin_tilt * (inputs.temperature * inputs.temperature * p[0]);
            let t27 = t26 * inputs.range;
            let t31 = (inputs.temperature * p[4] + cos_tilt * p[5]) * inputs.range;
            let t35 = sin_tilt * t31;
            [
                -(cos_pan * t35 + sin_pan * t27),
                cos_pan * t27 - sin_pan * t35,
                inputs.temperature * p[3] - cos_tilt * t31,
            ]
        }
        /// [`spot_first_order`](Self::spot_first_order) of many poses.
        ///
        /// `out` receives x, y and z.
        ///
        /// # Errors
        ///
        /// If the slices have different lengths.
        pub fn spot_first_order_rows(
            &self,
            joints: &JointRows<'_>,
            inputs: &InputRows<'_>,
            out: [&mut [f64]; 3],
        ) -> Result<(), LengthsDiffer> {
            let p = &self.spot_first_order_prepared();
            fill(
                out,
                |rows| joints.have_length(rows) && inputs.have_length(rows),
                |row| Self::spot_first_order_at(p, &joints.at(row), &inputs.at(row)),
            )
        }
        /// Derivatives of [`spot`](Self::spot) with respect to the errors, where they are zero.
        ///
        /// The columns are in the order of the fields of [`Errors`].
        #[must_use]
        pub fn spot_jacobian(
            &self,
            joints: &Joints,
            inputs: &Inputs,
        ) -> SMatrix<f64, 3, 6> {
            let p: [f64; 1] = {
                let errors = &self.errors;
                let constants = &self.constants;
                [constants.column]
            };
            let (sin_pan, cos_pan) = ComplexField::sin_cos(joints.pan);
            let (sin_tilt, cos_tilt) = ComplexField::sin_cos(joints.tilt);
            let t9 = cos_pan * sin_tilt;
            let t10 = sin_pan * sin_tilt;
            let t12 = cos_tilt * inputs.range;
            let t20 = t12 * inputs.reversal;
            let t26 = t12 * inputs.temperature;
            let t33 = sin_tilt * inputs.range
                * (0.01 * (inputs.temperature * inputs.temperature));
            let t37 = inputs.range * inputs.temperature;
            SMatrix::from([
                [-(sin_pan * t20), cos_pan * t20, 0.0],
                [-(sin_pan * t26), cos_pan * t26, 0.0],
                [0.0, 0.0, p[0] * inputs.temperature],
                [-(sin_pan * t33), cos_pan * t33, 0.0],
                [-(t9 * t12), -(t10 * t12), -(cos_tilt * t12)],
                [-(t9 * t37), -(t10 * t37), -(cos_tilt * t37)],
            ])
        }
        /// [`spot_jacobian`](Self::spot_jacobian) of many poses.
        ///
        /// # Errors
        ///
        /// If the slices have different lengths.
        pub fn spot_jacobian_rows(
            &self,
            joints: &JointRows<'_>,
            inputs: &InputRows<'_>,
            out: &mut [SMatrix<f64, 3, 6>],
        ) -> Result<(), LengthsDiffer> {
            let rows = out.len();
            if !(joints.have_length(rows) && inputs.have_length(rows)) {
                return Err(LengthsDiffer);
            }
            for (row, out) in out.iter_mut().enumerate() {
                *out = self.spot_jacobian(&joints.at(row), &inputs.at(row));
            }
            Ok(())
        }
        /// The first-order error of `line` as text: x, y and z.
        pub const LINE_FIRST_ORDER: [&'static str; 3] = [
            "-0.01*temperature^2*bend*sin(pan)*sin(tilt) - temperature*lean*cos(pan)*sin(tilt) - (temperature*drift + reversal*backlash)*sin(pan)*cos(tilt) - 1/2*sag*cos(pan)*sin(2*tilt)",
            "0.01*temperature^2*bend*cos(pan)*sin(tilt) + (temperature*drift + reversal*backlash)*cos(pan)*cos(tilt) - temperature*lean*sin(pan)*sin(tilt) - 1/2*sag*sin(pan)*sin(2*tilt)",
            "-temperature*lean*cos(tilt) - sag*cos(tilt)^2",
        ];
        /// The first-order error of `line` in LaTeX: x, y and z.
        pub const LINE_FIRST_ORDER_LATEX: [&'static str; 3] = [
            "-0.01 \\mathrm{temperature}^{2} \\mathrm{bend} \\sin \\mathrm{pan} \\sin \\mathrm{tilt} - \\mathrm{temperature} \\mathrm{lean} \\cos \\mathrm{pan} \\sin \\mathrm{tilt} - \\left(\\mathrm{temperature} \\mathrm{drift} + \\mathrm{reversal} \\mathrm{backlash}\\right) \\sin \\mathrm{pan} \\cos \\mathrm{tilt} - \\frac{1}{2} \\mathrm{sag} \\cos \\mathrm{pan} \\sin 2 \\mathrm{tilt}",
            "0.01 \\mathrm{temperature}^{2} \\mathrm{bend} \\cos \\mathrm{pan} \\sin \\mathrm{tilt} + \\left(\\mathrm{temperature} \\mathrm{drift} + \\mathrm{reversal} \\mathrm{backlash}\\right) \\cos \\mathrm{pan} \\cos \\mathrm{tilt} - \\mathrm{temperature} \\mathrm{lean} \\sin \\mathrm{pan} \\sin \\mathrm{tilt} - \\frac{1}{2} \\mathrm{sag} \\sin \\mathrm{pan} \\sin 2 \\mathrm{tilt}",
            "-\\mathrm{temperature} \\mathrm{lean} \\cos \\mathrm{tilt} - \\mathrm{sag} \\cos^{2} \\mathrm{tilt}",
        ];
        /// The observable `line`.
        ///
        /// With its errors, in the ground frame: a direction, without unit.
        #[must_use]
        pub fn line(&self, joints: &Joints, inputs: &Inputs) -> Vector3<f64> {
            let (nominal, difference) = self.line_parts(joints, inputs);
            nominal + difference
        }
        /// What the errors add to [`line`](Self::line), exactly.
        ///
        /// In the ground frame, with full relative precision however small the errors are.
        #[must_use]
        pub fn line_error(&self, joints: &Joints, inputs: &Inputs) -> Vector3<f64> {
            self.line_parts(joints, inputs).1
        }
        /// [`line`](Self::line) without errors, and what they add.
        fn line_parts(
            &self,
            joints: &Joints,
            inputs: &Inputs,
        ) -> (Vector3<f64>, Vector3<f64>) {
            let p: [f64; 5] = {
                let errors = &self.errors;
                let constants = &self.constants;
                [
                    errors.lean,
                    errors.sag,
                    0.01 * errors.bend,
                    errors.drift,
                    errors.backlash,
                ]
            };
            let (sin_tilt, cos_tilt) = ComplexField::sin_cos(joints.tilt);
            let (sin_pan, cos_pan) = ComplexField::sin_cos(joints.pan);
            let mut nominal = Vector3::new(1.0, 0.0, 0.0);
            let mut difference = Vector3::new(0.0, 0.0, 0.0);
            difference
                += departure_y(inputs.temperature * p[0] + p[1] * cos_tilt)
                    * (nominal + difference);
            let rotation = rotation_y(sin_tilt, cos_tilt);
            (nominal, difference) = (rotation * nominal, rotation * difference);
            difference
                += departure_x(inputs.temperature * inputs.temperature * p[2])
                    * (nominal + difference);
            difference
                += departure_z(inputs.temperature * p[3] + inputs.reversal * p[4])
                    * (nominal + difference);
            let rotation = rotation_z(sin_pan, cos_pan);
            (nominal, difference) = (rotation * nominal, rotation * difference);
            (nominal, difference)
        }
        /// [`line_error`](Self::line_error) of many poses.
        ///
        /// `out` receives x, y and z.
        ///
        /// # Errors
        ///
        /// If the slices have different lengths.
        pub fn line_error_rows(
            &self,
            joints: &JointRows<'_>,
            inputs: &InputRows<'_>,
            out: [&mut [f64]; 3],
        ) -> Result<(), LengthsDiffer> {
            fill(
                out,
                |rows| joints.have_length(rows) && inputs.have_length(rows),
                |row| self.line_error(&joints.at(row), &inputs.at(row)).into(),
            )
        }
        /// What the errors add to [`line`](Self::line), to first order.
        ///
        /// Products of two or more errors are dropped.
        #[must_use]
        pub fn line_first_order(
            &self,
            joints: &Joints,
            inputs: &Inputs,
        ) -> Vector3<f64> {
            Self::line_first_order_at(&self.line_first_order_prepared(), joints, inputs)
                .into()
        }
        /// What of [`line_first_order`](Self::line_first_order) no pose changes.
        fn line_first_order_prepared(&self) -> [f64; 5] {
            let errors = &self.errors;
            let constants = &self.constants;
            [0.01 * errors.bend, errors.drift, errors.backlash, errors.lean, errors.sag]
        }
        /// The rest of [`line_first_order`](Self::line_first_order), for one pose.
        fn line_first_order_at(
            p: &[f64; 5],
            joints: &Joints,
            inputs: &Inputs,
        ) -> [f64; 3] {
            let (sin_pan, cos_pan) = ComplexField::sin_cos(joints.pan);
            let (sin_tilt, cos_tilt) = ComplexField::sin_cos(joints.tilt);
            let t16 = inputs.temperature * p[3] + cos_tilt * p[4];
            let t19 = sin_tilt * t16;
            let t28 = cos_tilt * (inputs.temperature * p[1] + inputs.reversal * p[2])
                + sin_tilt * (inputs.temperature * inputs.temperature * p[0]);
            [
                -(cos_pan * t19 + sin_pan * t28),
                cos_pan * t28 - sin_pan * t19,
                -(cos_tilt * t16),
            ]
        }
        /// [`line_first_order`](Self::line_first_order) of many poses.
        ///
        /// `out` receives x, y and z.
        ///
        /// # Errors
        ///
        /// If the slices have different lengths.
        pub fn line_first_order_rows(
            &self,
            joints: &JointRows<'_>,
            inputs: &InputRows<'_>,
            out: [&mut [f64]; 3],
        ) -> Result<(), LengthsDiffer> {
            let p = &self.line_first_order_prepared();
            fill(
                out,
                |rows| joints.have_length(rows) && inputs.have_length(rows),
                |row| Self::line_first_order_at(p, &joints.at(row), &inputs.at(row)),
            )
        }
        /// Derivatives of [`line`](Self::line) with respect to the errors, where they are zero.
        ///
        /// The columns are in the order of the fields of [`Errors`].
        #[must_use]
        pub fn line_jacobian(
            &self,
            joints: &Joints,
            inputs: &Inputs,
        ) -> SMatrix<f64, 3, 6> {
            let p: [f64; 0] = {
                let errors = &self.errors;
                let constants = &self.constants;
                []
            };
            let (sin_pan, cos_pan) = ComplexField::sin_cos(joints.pan);
            let (sin_tilt, cos_tilt) = ComplexField::sin_cos(joints.tilt);
            let t10 = cos_pan * sin_tilt;
            let t13 = sin_pan * sin_tilt;
            let t17 = cos_tilt * inputs.reversal;
            let t26 = cos_tilt * inputs.temperature;
            let t33 = sin_tilt * (0.01 * (inputs.temperature * inputs.temperature));
            SMatrix::from([
                [-(sin_pan * t17), cos_pan * t17, 0.0],
                [-(sin_pan * t26), cos_pan * t26, 0.0],
                [0.0, 0.0, 0.0],
                [-(sin_pan * t33), cos_pan * t33, 0.0],
                [-(cos_tilt * t10), -(cos_tilt * t13), -(cos_tilt * cos_tilt)],
                [-(t10 * inputs.temperature), -(t13 * inputs.temperature), -t26],
            ])
        }
        /// [`line_jacobian`](Self::line_jacobian) of many poses.
        ///
        /// # Errors
        ///
        /// If the slices have different lengths.
        pub fn line_jacobian_rows(
            &self,
            joints: &JointRows<'_>,
            inputs: &InputRows<'_>,
            out: &mut [SMatrix<f64, 3, 6>],
        ) -> Result<(), LengthsDiffer> {
            let rows = out.len();
            if !(joints.have_length(rows) && inputs.have_length(rows)) {
                return Err(LengthsDiffer);
            }
            for (row, out) in out.iter_mut().enumerate() {
                *out = self.line_jacobian(&joints.at(row), &inputs.at(row));
            }
            Ok(())
        }
    }
    /// Where the joints stand, by their encoders.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    #[allow(dead_code, non_snake_case)]
    pub struct Joints {
        /// In radians; printed as `\mathrm{pan}`.
        pub pan: f64,
        /// In radians; printed as `\mathrm{tilt}`.
        pub tilt: f64,
    }
    impl From<[f64; 2]> for Joints {
        fn from(values: [f64; 2]) -> Self {
            Self {
                pan: values[0],
                tilt: values[1],
            }
        }
    }
    impl From<Joints> for [f64; 2] {
        fn from(values: Joints) -> Self {
            [values.pan, values.tilt]
        }
    }
    /// Joints of many poses: a slice for each joint, all equally long.
    #[derive(Debug, Clone, Copy)]
    #[allow(dead_code, non_snake_case)]
    pub struct JointRows<'a> {
        /// In radians; printed as `\mathrm{pan}`.
        pub pan: &'a [f64],
        /// In radians; printed as `\mathrm{tilt}`.
        pub tilt: &'a [f64],
    }
    #[allow(dead_code, non_snake_case)]
    impl JointRows<'_> {
        fn have_length(&self, rows: usize) -> bool {
            [self.pan.len(), self.tilt.len()].iter().all(|&length| length == rows)
        }
        fn at(&self, row: usize) -> Joints {
            Joints {
                pan: self.pan[row],
                tilt: self.tilt[row],
            }
        }
    }
    /// What is measured beside the joints.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    #[allow(dead_code, non_snake_case)]
    pub struct Inputs {
        /// A number, in the unit of the data; printed as `\mathrm{temperature}`.
        pub temperature: f64,
        /// In metres; printed as `\mathrm{range}`.
        pub range: f64,
        /// A number, in the unit of the data; printed as `\mathrm{reversal}`.
        pub reversal: f64,
    }
    impl From<[f64; 3]> for Inputs {
        fn from(values: [f64; 3]) -> Self {
            Self {
                temperature: values[0],
                range: values[1],
                reversal: values[2],
            }
        }
    }
    impl From<Inputs> for [f64; 3] {
        fn from(values: Inputs) -> Self {
            [values.temperature, values.range, values.reversal]
        }
    }
    /// Inputs of many poses: a slice for each input, all equally long.
    #[derive(Debug, Clone, Copy)]
    #[allow(dead_code, non_snake_case)]
    pub struct InputRows<'a> {
        /// A number, in the unit of the data; printed as `\mathrm{temperature}`.
        pub temperature: &'a [f64],
        /// In metres; printed as `\mathrm{range}`.
        pub range: &'a [f64],
        /// A number, in the unit of the data; printed as `\mathrm{reversal}`.
        pub reversal: &'a [f64],
    }
    #[allow(dead_code, non_snake_case)]
    impl InputRows<'_> {
        fn have_length(&self, rows: usize) -> bool {
            [self.temperature.len(), self.range.len(), self.reversal.len()]
                .iter()
                .all(|&length| length == rows)
        }
        fn at(&self, row: usize) -> Inputs {
            Inputs {
                temperature: self.temperature[row],
                range: self.range[row],
                reversal: self.reversal[row],
            }
        }
    }
    /// What differs from the design: nothing where all are zero.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    #[allow(dead_code, non_snake_case)]
    pub struct Errors {
        /// In radians; printed as `\mathrm{backlash}`.
        pub backlash: f64,
        /// In radians; printed as `\mathrm{drift}`.
        pub drift: f64,
        /// A number, in the unit of the data; printed as `\mathrm{growth}`.
        pub growth: f64,
        /// In radians; printed as `\mathrm{bend}`.
        pub bend: f64,
        /// In radians; printed as `\mathrm{sag}`.
        pub sag: f64,
        /// In radians; printed as `\mathrm{lean}`.
        pub lean: f64,
    }
    impl From<[f64; 6]> for Errors {
        fn from(values: [f64; 6]) -> Self {
            Self {
                backlash: values[0],
                drift: values[1],
                growth: values[2],
                bend: values[3],
                sag: values[4],
                lean: values[5],
            }
        }
    }
    impl From<Errors> for [f64; 6] {
        fn from(values: Errors) -> Self {
            [
                values.backlash,
                values.drift,
                values.growth,
                values.bend,
                values.sag,
                values.lean,
            ]
        }
    }
    /// The sizes of the geometry.
    #[derive(Debug, Clone, Copy, PartialEq)]
    #[allow(dead_code, non_snake_case)]
    pub struct Constants {
        /// In metres; 0.4 as declared; printed as `\mathrm{column}`.
        pub column: f64,
    }
    impl From<[f64; 1]> for Constants {
        fn from(values: [f64; 1]) -> Self {
            Self { column: values[0] }
        }
    }
    impl From<Constants> for [f64; 1] {
        fn from(values: Constants) -> Self {
            [values.column]
        }
    }
    /// As declared.
    impl Default for Constants {
        fn default() -> Self {
            Self { column: 0.4 }
        }
    }
    /// Slices that should be equally long are not, or a block is asked for more rows than it has.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[allow(dead_code)]
    pub struct LengthsDiffer;
    impl core::fmt::Display for LengthsDiffer {
        fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
            f.write_str(
                "slices of joints, inputs and results must be equally long, and no longer than a block where one is filled",
            )
        }
    }
    impl core::error::Error for LengthsDiffer {}
    /// Fills a slice for each number, row by row.
    fn fill<const N: usize>(
        mut out: [&mut [f64]; N],
        have_length: impl Fn(usize) -> bool,
        value: impl Fn(usize) -> [f64; N],
    ) -> Result<(), LengthsDiffer> {
        let rows = out[0].len();
        if !(out.iter().all(|slice| slice.len() == rows) && have_length(rows)) {
            return Err(LengthsDiffer);
        }
        for row in 0..rows {
            for (slice, number) in out.iter_mut().zip(value(row)) {
                slice[row] = number;
            }
        }
        Ok(())
    }
    /// The rotation by the angle that has this sine and cosine.
    fn rotation_y(sin: f64, cos: f64) -> Matrix3<f64> {
        Matrix3::new(cos, 0.0, sin, 0.0, 1.0, 0.0, -sin, 0.0, cos)
    }
    /// The rotation by the angle that has this sine and cosine.
    fn rotation_z(sin: f64, cos: f64) -> Matrix3<f64> {
        Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0)
    }
    /// The rotation by an angle, less the identity: without cancellation for small angles.
    fn departure_x(angle: f64) -> Matrix3<f64> {
        let (sin, cos) = ComplexField::sin_cos(0.5 * angle);
        let (sine, versine) = (2.0 * sin * cos, 2.0 * sin * sin);
        Matrix3::new(0.0, 0.0, 0.0, 0.0, -versine, -sine, 0.0, sine, -versine)
    }
    /// The rotation by an angle, less the identity: without cancellation for small angles.
    fn departure_y(angle: f64) -> Matrix3<f64> {
        let (sin, cos) = ComplexField::sin_cos(0.5 * angle);
        let (sine, versine) = (2.0 * sin * cos, 2.0 * sin * sin);
        Matrix3::new(-versine, 0.0, sine, 0.0, 0.0, 0.0, -sine, 0.0, -versine)
    }
    /// The rotation by an angle, less the identity: without cancellation for small angles.
    fn departure_z(angle: f64) -> Matrix3<f64> {
        let (sin, cos) = ComplexField::sin_cos(0.5 * angle);
        let (sine, versine) = (2.0 * sin * cos, 2.0 * sin * sin);
        Matrix3::new(-versine, -sine, 0.0, sine, -versine, 0.0, 0.0, 0.0, 0.0)
    }
}
