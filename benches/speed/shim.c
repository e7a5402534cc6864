/* The generated functions of one path behind names of their own, for `candidates.rs`. */
#define mobile_lidar_exact_jacobian_place SPEED(exact_jacobian_place)
#define mobile_lidar_first_order_jacobian_place SPEED(first_order_jacobian_place)
#define mobile_lidar_path_taken SPEED(path_taken)
#define mobile_lidar_first_order_error_prepare SPEED(foe_prepare)
#define mobile_lidar_first_order_error SPEED(foe)
#define mobile_lidar_first_order_error_without_branch SPEED(foe_without_branch)
#define mobile_lidar_first_order_error_rows SPEED(foe_rows)
#define mobile_lidar_exact_error_prepare SPEED(ee_prepare)
#define mobile_lidar_exact_error SPEED(ee)
#define mobile_lidar_exact_error_rows SPEED(ee_rows)
#define mobile_lidar_exact_jacobian_prepare SPEED(ej_prepare)
#define mobile_lidar_exact_jacobian SPEED(ej)
#define mobile_lidar_exact_jacobian_rows SPEED(ej_rows)
#define mobile_lidar_exact_jacobian_rows_of_block SPEED(ej_rows_of_block)
#define mobile_lidar_first_order_jacobian_prepare SPEED(foj_prepare)
#define mobile_lidar_first_order_jacobian SPEED(foj)
#define mobile_lidar_first_order_jacobian_rows SPEED(foj_rows)
#define mobile_lidar_first_order_jacobian_rows_of_block SPEED(foj_rows_of_block)
#include "lidar.c"

static mobile_lidar_first_order_error_prepared first_order_error;
static mobile_lidar_exact_error_prepared exact_error;
static mobile_lidar_exact_jacobian_prepared exact_jacobian;
static TRUEAXIS_ALIGNED mobile_lidar_exact_jacobian_block exact_block;
static mobile_lidar_first_order_jacobian_prepared first_order_jacobian;
static TRUEAXIS_ALIGNED mobile_lidar_first_order_jacobian_block first_order_block;

/* `errors` are in the order of the declaration, as the structure's fields. */
void SPEED(prepare)(const mobile_lidar_errors *errors)
{
    mobile_lidar_first_order_error_prepare(errors, &first_order_error);
    mobile_lidar_exact_error_prepare(errors, &exact_error);
    mobile_lidar_exact_jacobian_prepare(errors, &exact_jacobian);
    mobile_lidar_first_order_jacobian_prepare(errors, &first_order_jacobian);
}

void SPEED(first_order_error)(size_t rows, const mobile_lidar_joint_rows *joints,
    const mobile_lidar_observed_rows *out)
{
    mobile_lidar_first_order_error_rows(&first_order_error, rows, joints, out);
}

void SPEED(exact_error)(size_t rows, const mobile_lidar_joint_rows *joints, const mobile_lidar_observed_rows *out)
{
    mobile_lidar_exact_error_rows(&exact_error, rows, joints, out);
}

void SPEED(exact_jacobian)(size_t rows, const mobile_lidar_joint_rows *joints)
{
    mobile_lidar_exact_jacobian_rows_of_block(&exact_jacobian, rows, joints, &exact_block);
}

void SPEED(first_order_jacobian)(size_t rows, const mobile_lidar_joint_rows *joints)
{
    mobile_lidar_first_order_jacobian_rows_of_block(&first_order_jacobian, rows, joints, &first_order_block);
}
