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
            "-1/100*temperature^2*range*bend*sin(pan)*sin(tilt) - temperature*range*lean*cos(pan)*sin(tilt) - (temperature*range*drift + range*reversal*backlash)*sin(pan)*cos(tilt) - 1/2*range*sag*cos(pan)*sin(2*tilt)",
            "1/100*temperature^2*range*bend*cos(pan)*sin(tilt) + (temperature*range*drift + range*reversal*backlash)*cos(pan)*cos(tilt) - temperature*range*lean*sin(pan)*sin(tilt) - 1/2*range*sag*sin(pan)*sin(2*tilt)",
            "-temperature*range*lean*cos(tilt) + temperature*growth*column - range*sag*cos(tilt)^2",
        ];
        /// The first-order error of `spot` in LaTeX: x, y and z.
        pub const SPOT_FIRST_ORDER_LATEX: [&'static str; 3] = [
            "-\\frac{1}{100} \\mathrm{temperature}^{2} \\mathrm{range} \\mathrm{bend} \\sin \\mathrm{pan} \\sin \\mathrm{tilt} - \\mathrm{temperature} \\mathrm{range} \\mathrm{lean} \\cos \\mathrm{pan} \\sin \\mathrm{tilt} - \\left(\\mathrm{temperature} \\mathrm{range} \\mathrm{drift} + \\mathrm{range} \\mathrm{reversal} \\mathrm{backlash}\\right) \\sin \\mathrm{pan} \\cos \\mathrm{tilt} - \\frac{1}{2} \\mathrm{range} \\mathrm{sag} \\cos \\mathrm{pan} \\sin 2 \\mathrm{tilt}",
            "\\frac{1}{100} \\mathrm{temperature}^{2} \\mathrm{range} \\mathrm{bend} \\cos \\mathrm{pan} \\sin \\mathrm{tilt} + \\left(\\mathrm{temperature} \\mathrm{range} \\mathrm{drift} + \\mathrm{range} \\mathrm{reversal} \\mathrm{backlash}\\right) \\cos \\mathrm{pan} \\cos \\mathrm{tilt} - \\mathrm{temperature} \\mathrm{range} \\mathrm{lean} \\sin \\mathrm{pan} \\sin \\mathrm{tilt} - \\frac{1}{2} \\mathrm{range} \\mathrm{sag} \\sin \\mathrm{pan} \\sin 2 \\mathrm{tilt}",
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
            let (sin_tilt, cos_tilt) = ComplexField::sin_cos(joints.tilt);
            let mut nominal = Vector3::new(inputs.range, 0.0, 0.0);
            let mut difference = Vector3::zeros();
            difference
                += departure_y(
                    inputs.temperature * self.errors.lean + self.errors.sag * cos_tilt,
                ) * (nominal + difference);
            let (sin, cos) = ComplexField::sin_cos(joints.tilt);
            let rotation = rotation_y(sin, cos);
            nominal = rotation * nominal;
            difference = rotation * difference;
            difference
                += departure_x(
                    0.01 * inputs.temperature * inputs.temperature * self.errors.bend,
                ) * (nominal + difference);
            difference.z
                += inputs.temperature * self.errors.growth * self.constants.column;
            nominal.z += self.constants.column;
            difference
                += departure_z(
                    inputs.temperature * self.errors.drift
                        + inputs.reversal * self.errors.backlash,
                ) * (nominal + difference);
            let (sin, cos) = ComplexField::sin_cos(joints.pan);
            let rotation = rotation_z(sin, cos);
            nominal = rotation * nominal;
            difference = rotation * difference;
            (nominal, difference)
        }
        /// [`spot_error`](Self::spot_error) of many poses.
        ///
        /// `out` receives x, y and z.
        ///
        /// # Errors
        ///
        /// If the slices have different lengths.
        pub fn spot_error_over(
            &self,
            joints: &JointSlices<'_>,
            inputs: &InputSlices<'_>,
            out: [&mut [f64]; 3],
        ) -> Result<(), UnequalLengths> {
            let [x, y, z] = out;
            let length = x.len();
            let all_equal = y.len() == length && z.len() == length
                && joints.have_length(length) && inputs.have_length(length);
            if !all_equal {
                return Err(UnequalLengths);
            }
            for pose in 0..length {
                let joints = &joints.at(pose);
                let inputs = &inputs.at(pose);
                let error = self.spot_error(joints, inputs);
                x[pose] = error.x;
                y[pose] = error.y;
                z[pose] = error.z;
            }
            Ok(())
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
            let t3 = 0.01 * self.errors.bend;
            let t7 = self.constants.column * self.errors.growth;
            let (t11, t12) = ComplexField::sin_cos(joints.pan);
            let (t14, t15) = ComplexField::sin_cos(joints.tilt);
            let t18 = inputs.temperature * inputs.temperature;
            let t19 = t18 * t3;
            let t21 = inputs.temperature * self.errors.drift;
            let t22 = inputs.reversal * self.errors.backlash;
            let t23 = t21 + t22;
            let t24 = t15 * t23;
            let t25 = t14 * t19;
            let t26 = t24 + t25;
            let t27 = t26 * inputs.range;
            let t28 = inputs.temperature * self.errors.lean;
            let t29 = t15 * self.errors.sag;
            let t30 = t28 + t29;
            let t31 = t30 * inputs.range;
            let t32 = inputs.temperature * t7;
            let t33 = t15 * t31;
            let t34 = t32 - t33;
            let t35 = t14 * t31;
            let t36 = t12 * t35;
            let t37 = t11 * t27;
            let t38 = t36 + t37;
            let t39 = -t38;
            let t40 = t11 * t35;
            let t41 = t12 * t27;
            let t42 = t41 - t40;
            Vector3::new(t39, t42, t34)
        }
        /// [`spot_first_order`](Self::spot_first_order) of many poses.
        ///
        /// `out` receives x, y and z.
        ///
        /// # Errors
        ///
        /// If the slices have different lengths.
        pub fn spot_first_order_over(
            &self,
            joints: &JointSlices<'_>,
            inputs: &InputSlices<'_>,
            out: [&mut [f64]; 3],
        ) -> Result<(), UnequalLengths> {
            let [x, y, z] = out;
            let length = x.len();
            let all_equal = y.len() == length && z.len() == length
                && joints.have_length(length) && inputs.have_length(length);
            if !all_equal {
                return Err(UnequalLengths);
            }
            let t3 = 0.01 * self.errors.bend;
            let t7 = self.constants.column * self.errors.growth;
            for pose in 0..length {
                let joints = &joints.at(pose);
                let inputs = &inputs.at(pose);
                let (t11, t12) = ComplexField::sin_cos(joints.pan);
                let (t14, t15) = ComplexField::sin_cos(joints.tilt);
                let t18 = inputs.temperature * inputs.temperature;
                let t19 = t18 * t3;
                let t21 = inputs.temperature * self.errors.drift;
                let t22 = inputs.reversal * self.errors.backlash;
                let t23 = t21 + t22;
                let t24 = t15 * t23;
                let t25 = t14 * t19;
                let t26 = t24 + t25;
                let t27 = t26 * inputs.range;
                let t28 = inputs.temperature * self.errors.lean;
                let t29 = t15 * self.errors.sag;
                let t30 = t28 + t29;
                let t31 = t30 * inputs.range;
                let t32 = inputs.temperature * t7;
                let t33 = t15 * t31;
                let t34 = t32 - t33;
                let t35 = t14 * t31;
                let t36 = t12 * t35;
                let t37 = t11 * t27;
                let t38 = t36 + t37;
                let t39 = -t38;
                let t40 = t11 * t35;
                let t41 = t12 * t27;
                let t42 = t41 - t40;
                x[pose] = t39;
                y[pose] = t42;
                z[pose] = t34;
            }
            Ok(())
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
            let (t4, t5) = ComplexField::sin_cos(joints.pan);
            let (t7, t8) = ComplexField::sin_cos(joints.tilt);
            let t9 = t5 * t7;
            let t10 = t4 * t7;
            let t12 = t8 * inputs.range;
            let t13 = t9 * t12;
            let t14 = -t13;
            let t15 = t10 * t12;
            let t16 = -t15;
            let t17 = t8 * t12;
            let t18 = -t17;
            let t20 = t12 * inputs.reversal;
            let t21 = t5 * t20;
            let t22 = t4 * t20;
            let t23 = -t22;
            let t25 = self.constants.column * inputs.temperature;
            let t26 = t12 * inputs.temperature;
            let t27 = t5 * t26;
            let t28 = t4 * t26;
            let t29 = -t28;
            let t30 = t7 * inputs.range;
            let t31 = inputs.temperature * inputs.temperature;
            let t32 = 0.01 * t31;
            let t33 = t30 * t32;
            let t34 = t5 * t33;
            let t35 = t4 * t33;
            let t36 = -t35;
            let t37 = inputs.range * inputs.temperature;
            let t38 = t9 * t37;
            let t39 = -t38;
            let t40 = t10 * t37;
            let t41 = -t40;
            let t42 = t8 * t37;
            let t43 = -t42;
            SMatrix::from([
                [t23, t21, 0.0],
                [t29, t27, 0.0],
                [0.0, 0.0, t25],
                [t36, t34, 0.0],
                [t14, t16, t18],
                [t39, t41, t43],
            ])
        }
        /// [`spot_jacobian`](Self::spot_jacobian) of many poses.
        ///
        /// # Errors
        ///
        /// If the slices have different lengths.
        pub fn spot_jacobian_over(
            &self,
            joints: &JointSlices<'_>,
            inputs: &InputSlices<'_>,
            out: &mut [SMatrix<f64, 3, 6>],
        ) -> Result<(), UnequalLengths> {
            let length = out.len();
            let all_equal = joints.have_length(length) && inputs.have_length(length);
            if !all_equal {
                return Err(UnequalLengths);
            }
            for pose in 0..length {
                let joints = &joints.at(pose);
                let inputs = &inputs.at(pose);
                out[pose] = self.spot_jacobian(joints, inputs);
            }
            Ok(())
        }
        /// The first-order error of `line` as text: x, y and z.
        pub const LINE_FIRST_ORDER: [&'static str; 3] = [
            "-1/100*temperature^2*bend*sin(pan)*sin(tilt) - temperature*lean*cos(pan)*sin(tilt) - (temperature*drift + reversal*backlash)*sin(pan)*cos(tilt) - 1/2*sag*cos(pan)*sin(2*tilt)",
            "1/100*temperature^2*bend*cos(pan)*sin(tilt) + (temperature*drift + reversal*backlash)*cos(pan)*cos(tilt) - temperature*lean*sin(pan)*sin(tilt) - 1/2*sag*sin(pan)*sin(2*tilt)",
            "-temperature*lean*cos(tilt) - sag*cos(tilt)^2",
        ];
        /// The first-order error of `line` in LaTeX: x, y and z.
        pub const LINE_FIRST_ORDER_LATEX: [&'static str; 3] = [
            "-\\frac{1}{100} \\mathrm{temperature}^{2} \\mathrm{bend} \\sin \\mathrm{pan} \\sin \\mathrm{tilt} - \\mathrm{temperature} \\mathrm{lean} \\cos \\mathrm{pan} \\sin \\mathrm{tilt} - \\left(\\mathrm{temperature} \\mathrm{drift} + \\mathrm{reversal} \\mathrm{backlash}\\right) \\sin \\mathrm{pan} \\cos \\mathrm{tilt} - \\frac{1}{2} \\mathrm{sag} \\cos \\mathrm{pan} \\sin 2 \\mathrm{tilt}",
            "\\frac{1}{100} \\mathrm{temperature}^{2} \\mathrm{bend} \\cos \\mathrm{pan} \\sin \\mathrm{tilt} + \\left(\\mathrm{temperature} \\mathrm{drift} + \\mathrm{reversal} \\mathrm{backlash}\\right) \\cos \\mathrm{pan} \\cos \\mathrm{tilt} - \\mathrm{temperature} \\mathrm{lean} \\sin \\mathrm{pan} \\sin \\mathrm{tilt} - \\frac{1}{2} \\mathrm{sag} \\sin \\mathrm{pan} \\sin 2 \\mathrm{tilt}",
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
            let (sin_tilt, cos_tilt) = ComplexField::sin_cos(joints.tilt);
            let mut nominal = Vector3::new(1.0, 0.0, 0.0);
            let mut difference = Vector3::zeros();
            difference
                += departure_y(
                    inputs.temperature * self.errors.lean + self.errors.sag * cos_tilt,
                ) * (nominal + difference);
            let (sin, cos) = ComplexField::sin_cos(joints.tilt);
            let rotation = rotation_y(sin, cos);
            nominal = rotation * nominal;
            difference = rotation * difference;
            difference
                += departure_x(
                    0.01 * inputs.temperature * inputs.temperature * self.errors.bend,
                ) * (nominal + difference);
            difference
                += departure_z(
                    inputs.temperature * self.errors.drift
                        + inputs.reversal * self.errors.backlash,
                ) * (nominal + difference);
            let (sin, cos) = ComplexField::sin_cos(joints.pan);
            let rotation = rotation_z(sin, cos);
            nominal = rotation * nominal;
            difference = rotation * difference;
            (nominal, difference)
        }
        /// [`line_error`](Self::line_error) of many poses.
        ///
        /// `out` receives x, y and z.
        ///
        /// # Errors
        ///
        /// If the slices have different lengths.
        pub fn line_error_over(
            &self,
            joints: &JointSlices<'_>,
            inputs: &InputSlices<'_>,
            out: [&mut [f64]; 3],
        ) -> Result<(), UnequalLengths> {
            let [x, y, z] = out;
            let length = x.len();
            let all_equal = y.len() == length && z.len() == length
                && joints.have_length(length) && inputs.have_length(length);
            if !all_equal {
                return Err(UnequalLengths);
            }
            for pose in 0..length {
                let joints = &joints.at(pose);
                let inputs = &inputs.at(pose);
                let error = self.line_error(joints, inputs);
                x[pose] = error.x;
                y[pose] = error.y;
                z[pose] = error.z;
            }
            Ok(())
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
            let t2 = 0.01 * self.errors.bend;
            let (t8, t9) = ComplexField::sin_cos(joints.pan);
            let (t11, t12) = ComplexField::sin_cos(joints.tilt);
            let t14 = inputs.temperature * self.errors.lean;
            let t15 = t12 * self.errors.sag;
            let t16 = t14 + t15;
            let t17 = t12 * t16;
            let t18 = -t17;
            let t19 = t11 * t16;
            let t20 = inputs.temperature * inputs.temperature;
            let t21 = t20 * t2;
            let t23 = inputs.temperature * self.errors.drift;
            let t24 = inputs.reversal * self.errors.backlash;
            let t25 = t23 + t24;
            let t26 = t12 * t25;
            let t27 = t11 * t21;
            let t28 = t26 + t27;
            let t29 = t9 * t19;
            let t30 = t8 * t28;
            let t31 = t29 + t30;
            let t32 = -t31;
            let t33 = t8 * t19;
            let t34 = t9 * t28;
            let t35 = t34 - t33;
            Vector3::new(t32, t35, t18)
        }
        /// [`line_first_order`](Self::line_first_order) of many poses.
        ///
        /// `out` receives x, y and z.
        ///
        /// # Errors
        ///
        /// If the slices have different lengths.
        pub fn line_first_order_over(
            &self,
            joints: &JointSlices<'_>,
            inputs: &InputSlices<'_>,
            out: [&mut [f64]; 3],
        ) -> Result<(), UnequalLengths> {
            let [x, y, z] = out;
            let length = x.len();
            let all_equal = y.len() == length && z.len() == length
                && joints.have_length(length) && inputs.have_length(length);
            if !all_equal {
                return Err(UnequalLengths);
            }
            let t2 = 0.01 * self.errors.bend;
            for pose in 0..length {
                let joints = &joints.at(pose);
                let inputs = &inputs.at(pose);
                let (t8, t9) = ComplexField::sin_cos(joints.pan);
                let (t11, t12) = ComplexField::sin_cos(joints.tilt);
                let t14 = inputs.temperature * self.errors.lean;
                let t15 = t12 * self.errors.sag;
                let t16 = t14 + t15;
                let t17 = t12 * t16;
                let t18 = -t17;
                let t19 = t11 * t16;
                let t20 = inputs.temperature * inputs.temperature;
                let t21 = t20 * t2;
                let t23 = inputs.temperature * self.errors.drift;
                let t24 = inputs.reversal * self.errors.backlash;
                let t25 = t23 + t24;
                let t26 = t12 * t25;
                let t27 = t11 * t21;
                let t28 = t26 + t27;
                let t29 = t9 * t19;
                let t30 = t8 * t28;
                let t31 = t29 + t30;
                let t32 = -t31;
                let t33 = t8 * t19;
                let t34 = t9 * t28;
                let t35 = t34 - t33;
                x[pose] = t32;
                y[pose] = t35;
                z[pose] = t18;
            }
            Ok(())
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
            let (t3, t4) = ComplexField::sin_cos(joints.pan);
            let (t6, t7) = ComplexField::sin_cos(joints.tilt);
            let t8 = t7 * t7;
            let t9 = -t8;
            let t10 = t4 * t6;
            let t11 = t7 * t10;
            let t12 = -t11;
            let t13 = t3 * t6;
            let t14 = t7 * t13;
            let t15 = -t14;
            let t17 = t7 * inputs.reversal;
            let t18 = t4 * t17;
            let t19 = t3 * t17;
            let t20 = -t19;
            let t22 = t10 * inputs.temperature;
            let t23 = -t22;
            let t24 = t13 * inputs.temperature;
            let t25 = -t24;
            let t26 = t7 * inputs.temperature;
            let t27 = t4 * t26;
            let t28 = t3 * t26;
            let t29 = -t28;
            let t30 = -t26;
            let t31 = inputs.temperature * inputs.temperature;
            let t32 = 0.01 * t31;
            let t33 = t6 * t32;
            let t34 = t4 * t33;
            let t35 = t3 * t33;
            let t36 = -t35;
            SMatrix::from([
                [t20, t18, 0.0],
                [t29, t27, 0.0],
                [0.0, 0.0, 0.0],
                [t36, t34, 0.0],
                [t12, t15, t9],
                [t23, t25, t30],
            ])
        }
        /// [`line_jacobian`](Self::line_jacobian) of many poses.
        ///
        /// # Errors
        ///
        /// If the slices have different lengths.
        pub fn line_jacobian_over(
            &self,
            joints: &JointSlices<'_>,
            inputs: &InputSlices<'_>,
            out: &mut [SMatrix<f64, 3, 6>],
        ) -> Result<(), UnequalLengths> {
            let length = out.len();
            let all_equal = joints.have_length(length) && inputs.have_length(length);
            if !all_equal {
                return Err(UnequalLengths);
            }
            for pose in 0..length {
                let joints = &joints.at(pose);
                let inputs = &inputs.at(pose);
                out[pose] = self.line_jacobian(joints, inputs);
            }
            Ok(())
        }
    }
    /// Where the joints stand, by their encoders.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    pub struct Joints {
        /// In radians; printed as `\mathrm{pan}`.
        pub pan: f64,
        /// In radians; printed as `\mathrm{tilt}`.
        pub tilt: f64,
    }
    impl From<[f64; 2]> for Joints {
        fn from([pan, tilt]: [f64; 2]) -> Self {
            Self { pan, tilt }
        }
    }
    impl From<Joints> for [f64; 2] {
        fn from(joints: Joints) -> Self {
            [joints.pan, joints.tilt]
        }
    }
    /// The joints of many poses: a slice for each joint, all of one length.
    #[derive(Debug, Clone, Copy)]
    pub struct JointSlices<'a> {
        /// In radians; printed as `\mathrm{pan}`.
        pub pan: &'a [f64],
        /// In radians; printed as `\mathrm{tilt}`.
        pub tilt: &'a [f64],
    }
    impl JointSlices<'_> {
        fn have_length(&self, length: usize) -> bool {
            [self.pan.len(), self.tilt.len()].iter().all(|&other| other == length)
        }
        fn at(&self, pose: usize) -> Joints {
            Joints {
                pan: self.pan[pose],
                tilt: self.tilt[pose],
            }
        }
    }
    /// What is measured beside the joints.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    pub struct Inputs {
        /// A number, in the unit of the data; printed as `\mathrm{temperature}`.
        pub temperature: f64,
        /// In metres; printed as `\mathrm{range}`.
        pub range: f64,
        /// A number, in the unit of the data; printed as `\mathrm{reversal}`.
        pub reversal: f64,
    }
    impl From<[f64; 3]> for Inputs {
        fn from([temperature, range, reversal]: [f64; 3]) -> Self {
            Self {
                temperature,
                range,
                reversal,
            }
        }
    }
    impl From<Inputs> for [f64; 3] {
        fn from(inputs: Inputs) -> Self {
            [inputs.temperature, inputs.range, inputs.reversal]
        }
    }
    /// The inputs of many poses: a slice for each input, all of one length.
    #[derive(Debug, Clone, Copy)]
    pub struct InputSlices<'a> {
        /// A number, in the unit of the data; printed as `\mathrm{temperature}`.
        pub temperature: &'a [f64],
        /// In metres; printed as `\mathrm{range}`.
        pub range: &'a [f64],
        /// A number, in the unit of the data; printed as `\mathrm{reversal}`.
        pub reversal: &'a [f64],
    }
    impl InputSlices<'_> {
        fn have_length(&self, length: usize) -> bool {
            [self.temperature.len(), self.range.len(), self.reversal.len()]
                .iter()
                .all(|&other| other == length)
        }
        fn at(&self, pose: usize) -> Inputs {
            Inputs {
                temperature: self.temperature[pose],
                range: self.range[pose],
                reversal: self.reversal[pose],
            }
        }
    }
    /// The errors; `Default` is the instrument without any.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
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
        fn from([backlash, drift, growth, bend, sag, lean]: [f64; 6]) -> Self {
            Self {
                backlash,
                drift,
                growth,
                bend,
                sag,
                lean,
            }
        }
    }
    impl From<Errors> for [f64; 6] {
        fn from(errors: Errors) -> Self {
            [
                errors.backlash,
                errors.drift,
                errors.growth,
                errors.bend,
                errors.sag,
                errors.lean,
            ]
        }
    }
    /// The sizes of the geometry; `Default` is as declared.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct Constants {
        /// In metres; 0.4 as declared; printed as `\mathrm{column}`.
        pub column: f64,
    }
    impl Default for Constants {
        fn default() -> Self {
            Self { column: 0.4 }
        }
    }
    /// The slices that were given have different lengths.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub struct UnequalLengths;
    impl ::core::fmt::Display for UnequalLengths {
        fn fmt(&self, f: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result {
            f.write_str("the slices have different lengths")
        }
    }
    impl ::core::error::Error for UnequalLengths {}
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
