//! How a table says how a body is turned: a small rotation from the design, a unit quaternion, a matrix, a rotation vector, three angles.

use std::ops::Range;

use model_core::{Axis, Quantity};
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};

use super::mistakes::{Outcome, mistake};
use super::written::{Column, Observed};
use observe::kinds::UNIT_TOLERANCE;
use observe::orientation::of_axes;

/// What the columns of an orientation are. All of them say what takes vectors of the body into the frame that it is seen in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// The vector ω of exp(ω×) R₀ with R₀ the orientation by design: what `eval` and `simulate` write.
    FromDesign,
    /// The vector ω of exp(ω×): axis times angle.
    Vector,
    /// A unit quaternion w + x i + y j + z k.
    Quaternion,
    /// Row by row; its columns are the axes of the body.
    Matrix,
    /// Three turns one after another, each about an axis as the turns before it have left it.
    Euler([Axis; 3]),
}

/// What to write in `[observed]`, form by form.
pub(super) const FORMS: &str = "a quaternion (`w`, `x`, `y`, `z`), a matrix (`r11`, `r12` to `r33`: first the row), a rotation vector \
    (`rx`, `ry`, `rz`), three angles (`e1`, `e2`, `e3` with `euler = \"zyx\"`), or what `eval` writes (`rotation_x`, `rotation_y`, `rotation_z`)";

/// Keys with the columns that they name.
type Keys<'a> = Vec<(&'static str, &'a Option<Column>)>;

impl Form {
    /// The keys of its columns, in order.
    #[must_use]
    pub fn keys(self) -> &'static [&'static str] {
        match self {
            Self::FromDesign => &["rotation_x", "rotation_y", "rotation_z"],
            Self::Vector => &["rx", "ry", "rz"],
            Self::Quaternion => &["w", "x", "y", "z"],
            Self::Matrix => &["r11", "r12", "r13", "r21", "r22", "r23", "r31", "r32", "r33"],
            Self::Euler(_) => &["e1", "e2", "e3"],
        }
    }

    /// What its numbers are.
    #[must_use]
    pub fn quantity(self) -> Quantity {
        match self {
            Self::FromDesign | Self::Vector | Self::Euler(_) => Quantity::Angle,
            Self::Quaternion | Self::Matrix => Quantity::Number,
        }
    }

    /// The orientation of one row; `design` is that without errors at its readings.
    ///
    /// # Errors
    /// Why the numbers are none.
    pub fn read(
        self,
        numbers: impl Fn(usize) -> f64,
        design: impl FnOnce() -> UnitQuaternion<f64>,
    ) -> Result<UnitQuaternion<f64>, String> {
        match self {
            Self::FromDesign | Self::Vector => {
                let vector = Vector3::new(numbers(0), numbers(1), numbers(2));
                if !vector.norm().is_finite() {
                    return Err("the rotation vector is too long to be one".to_owned());
                }
                let turn = UnitQuaternion::new(vector);
                if self == Self::Vector {
                    return Ok(turn);
                }
                let turned = turn * design();
                let is_number = turned.coords.iter().all(|part| part.is_finite());
                is_number
                    .then_some(turned)
                    .ok_or_else(|| "the chain has no orientation at these readings".to_owned())
            }
            Self::Quaternion => {
                let quaternion = Quaternion::new(numbers(0), numbers(1), numbers(2), numbers(3));
                let length = quaternion.norm();
                if (length - 1.0).abs() > UNIT_TOLERANCE {
                    return Err(format!("w, x, y, z is no unit quaternion: its length is {length:.6}"));
                }
                Ok(UnitQuaternion::from_quaternion(quaternion))
            }
            Self::Matrix => of_matrix(&Matrix3::from_fn(|row, column| numbers(3 * row + column))),
            Self::Euler(axes) => {
                let turn = |at: usize| {
                    let mut axis = Vector3::zeros();
                    axis[axes[at].index()] = numbers(at);
                    UnitQuaternion::new(axis)
                };
                let turned = turn(0) * turn(1) * turn(2);
                let is_number = turned.coords.iter().all(|part| part.is_finite());
                is_number
                    .then_some(turned)
                    .ok_or_else(|| "the three angles are too large to be some".to_owned())
            }
        }
    }
}

/// The rotation next to a matrix, which its digits make no rotation.
///
/// Source: with M = U S Vᵀ it is U Vᵀ, the nearest in the sum of squares.
fn of_matrix(matrix: &Matrix3<f64>) -> Result<UnitQuaternion<f64>, String> {
    let none = |why: String| Err(format!("r11 to r33 is no rotation matrix: {why}"));
    let largest = matrix.amax();
    if largest > 1.0 + UNIT_TOLERANCE {
        return none(format!("an entry is {largest:.6} large"));
    }
    let determinant = matrix.determinant();
    let svd = matrix.svd(true, true);
    let (Some(u), Some(v)) = (svd.u, svd.v_t) else {
        unreachable!("both were asked for");
    };
    let nearest = u * v;
    let off = (matrix - nearest).amax();
    if off > UNIT_TOLERANCE {
        return none(format!(
            "an entry is {off:.6} off the nearest one, and its determinant is {determinant:.6}"
        ));
    }
    if determinant < 0.0 {
        return none("it mirrors: an axis has the wrong sign, or two are swapped".to_owned());
    }
    Ok(of_axes(&nearest))
}

/// The axes of three angles; any where the study has none.
fn axes(observed: &Observed, place: &Range<usize>) -> Outcome<[Axis; 3]> {
    let named = ["e1", "e2", "e3"].iter().any(|key| observed.names(key));
    let Some(written) = &observed.euler else {
        if named {
            let message = "nothing says about which axes these angles turn";
            return Err(mistake(
                place.clone(),
                message,
                "write `euler = \"zyx\"`: first about z, then about the new y, then about the new x",
            ));
        }
        return Ok([Axis::Z, Axis::Y, Axis::X]);
    };
    axes_in_turn(&written.get_ref().to_ascii_lowercase()).ok_or_else(|| {
        let message = format!("`{}` are no three axes of which none follows itself", written.get_ref());
        mistake(written.span(), message, "write `euler = \"zyx\"` or another order of x, y and z")
    })
}

/// Three axes by their letters, as `zyx`; none where these are no three, or one follows itself.
#[must_use]
pub fn axes_in_turn(letters: &str) -> Option<[Axis; 3]> {
    let axis = |letter: char| match letter {
        'x' => Some(Axis::X),
        'y' => Some(Axis::Y),
        'z' => Some(Axis::Z),
        _ => None,
    };
    let axes: Vec<Axis> = letters.chars().map(axis).collect::<Option<_>>()?;
    let [first, second, third] = axes[..] else { return None };
    (first != second && second != third).then_some([first, second, third])
}

/// The form that the keys of `[observed]` say, and its columns in order.
pub(super) fn form<'a>(observed: &'a Observed, place: &Range<usize>) -> Outcome<(Form, Keys<'a>)> {
    let all = observed.columns();
    let of = |form: Form| -> (Form, Keys<'a>) {
        let column = |key: &&str| all.iter().copied().find(|(known, _)| known == key);
        (form, form.keys().iter().filter_map(column).collect())
    };
    let forms =
        [Form::FromDesign, Form::Vector, Form::Quaternion, Form::Matrix, Form::Euler(axes(observed, place)?)];
    let is_named = |(_, keys): &(Form, Keys<'_>)| keys.iter().any(|(_, column)| column.is_some());
    let mut named = forms.map(of).into_iter().filter(is_named);
    match (named.next(), named.next()) {
        (None, _) => Ok(of(Form::FromDesign)),
        (Some(one), None) => Ok(one),
        (Some((_, one)), Some((_, other))) => {
            let first =
                |keys: &Keys<'_>| keys.iter().find(|(_, own)| own.is_some()).map_or("", |(key, _)| key);
            let message =
                format!("`{}` and `{}` are of two ways to write an orientation", first(&one), first(&other));
            Err(mistake(place.clone(), message, format!("name the columns of one: {FORMS}")))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use observe::orientation::rotation_vector;

    fn read(form: Form, numbers: &[f64]) -> Result<Vector3<f64>, String> {
        let design = UnitQuaternion::identity;
        form.read(|at| numbers[at], design).map(|turn| rotation_vector(&turn))
    }

    /// A quarter turn about z, in every form.
    #[test]
    fn every_form_says_the_same() {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let quarter = Vector3::new(0.0, 0.0, std::f64::consts::FRAC_PI_2);
        for (form, numbers) in [
            (Form::FromDesign, vec![0.0, 0.0, quarter.z]),
            (Form::Vector, vec![0.0, 0.0, quarter.z]),
            (Form::Vector, vec![0.0, 0.0, -3.0 * quarter.z]),
            (Form::Quaternion, vec![half, 0.0, 0.0, half]),
            (Form::Quaternion, vec![-half, 0.0, 0.0, -half]),
            // Written with three digits.
            (Form::Quaternion, vec![0.707, 0.0, 0.0, 0.707]),
            (Form::Matrix, vec![0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0]),
            (Form::Euler([Axis::Z, Axis::Y, Axis::X]), vec![quarter.z, 0.0, 0.0]),
            (Form::Euler([Axis::Z, Axis::X, Axis::Z]), vec![quarter.z / 2.0, 0.0, quarter.z / 2.0]),
            // About y by a quarter, about the new x, which looks down, and back.
            (Form::Euler([Axis::Y, Axis::X, Axis::Y]), vec![quarter.z, -quarter.z, -quarter.z]),
        ] {
            assert_relative_eq!(read(form, &numbers).expect("an orientation"), quarter, epsilon = 1e-12);
        }
    }

    #[test]
    fn what_is_no_rotation_says_how_far_off_it_is() {
        let of = |form, numbers: &[f64]| read(form, numbers).expect_err("no orientation");
        assert_eq!(
            of(Form::Quaternion, &[1.0, 0.0, 0.1, 0.0]),
            "w, x, y, z is no unit quaternion: its length is 1.004988"
        );
        assert!(of(Form::Quaternion, &[0.0; 4]).contains("its length is 0.000000"));
        assert!(of(Form::Vector, &[1e300, 1e300, 0.0]).contains("too long"));
        let mut matrix = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        matrix[8] = -1.0;
        assert!(of(Form::Matrix, &matrix).contains("it mirrors"));
        matrix[8] = 1.01;
        assert!(of(Form::Matrix, &matrix).contains("an entry is 1.010000 large"));
        matrix[8] = 1e300;
        assert!(of(Form::Matrix, &matrix).contains("no rotation matrix"));
        matrix[8] = 0.98;
        assert!(of(Form::Matrix, &matrix).contains("0.020000 off the nearest one"));
        assert!(of(Form::Matrix, &[0.0; 9]).contains("its determinant is 0.000000"));
    }
}
