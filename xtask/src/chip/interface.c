/* Every function of a project of `host-sim new c` with the cart-pendulum, and what it refuses. Prints what is not as it must be. */
#include "cart_for_c.h"

void print(const char *text);

static int failed;

static void must(int holds, const char *what) {
    if (!holds) {
        failed = 1;
        print(what);
        print("\n");
    }
}

int main(void) {
    static uint8_t bytes[4096];
    cart_for_c_number values[CART_FOR_C_MOST_VALUES];
    cart_for_c_number position[3];
    double orientation[4];
    char why[100];
    must(cart_for_c_step() == CART_FOR_C_NO_PLANT, "a step before the plant");
    must(cart_for_c_init() == CART_FOR_C_OK, "init");
    must(cart_for_c_set_input(CART_FOR_C_INPUT_DRIVE, 2) == CART_FOR_C_OK, "set_input");
    for (int step = 0; step < 1000; step++) {
        must(cart_for_c_step() == CART_FOR_C_OK, "step");
    }
    must(cart_for_c_steps() == 1000, "steps");
    must(cart_for_c_read(CART_FOR_C_READOUT_ANGLE, values) == 1 && values[0] != 0, "read");
    must(cart_for_c_pose(CART_FOR_C_BODY_PENDULUM, position, orientation) == CART_FOR_C_OK, "pose");
    double norm = 0;
    for (int part = 0; part < 4; part++) {
        norm += orientation[part] * orientation[part];
    }
    must(norm > 0.999 && norm < 1.001, "a unit quaternion");
    must(cart_for_c_pose(CART_FOR_C_BODY_CART, position, orientation) == CART_FOR_C_OK, "pose of the cart");
    must(cart_for_c_read(CART_FOR_C_READOUT_CART_POINT, values) == 3, "a vector");
    for (int part = 0; part < 3; part++) {
        must(values[part] == position[part], "the place of the cart");
    }
    must(position[0] > 0.01f, "the cart has moved");

    int32_t size = cart_for_c_snapshot(0, 0);
    must(size > 0 && size <= (int32_t)sizeof bytes, "the size of a snapshot");
    must(cart_for_c_snapshot(bytes, (uint32_t)size - 1) == CART_FOR_C_SNAPSHOT_REFUSED, "too little room");
    must(cart_for_c_snapshot(bytes, sizeof bytes) == size, "snapshot");
    uint64_t before = cart_for_c_hash();
    must(cart_for_c_step() == CART_FOR_C_OK && cart_for_c_hash() != before, "a step changes the state");
    uint64_t after = cart_for_c_hash();
    must(cart_for_c_init() == CART_FOR_C_OK && cart_for_c_steps() == 0, "init again");
    must(cart_for_c_restore(bytes, (uint32_t)size) == CART_FOR_C_OK, "restore");
    must(cart_for_c_hash() == before && cart_for_c_steps() == 1000, "the state of the snapshot");
    must(cart_for_c_step() == CART_FOR_C_OK && cart_for_c_hash() == after, "goes on with its bits");
    bytes[10] ^= 1;
    must(cart_for_c_restore(bytes, (uint32_t)size) == CART_FOR_C_SNAPSHOT_REFUSED, "a damaged snapshot");

    must(cart_for_c_set_input(99, 0) == CART_FOR_C_BAD_ARGUMENT, "no such input");
    must(cart_for_c_set_input(CART_FOR_C_INPUT_DRIVE, __builtin_nanf("")) == CART_FOR_C_BAD_ARGUMENT, "no number");
    must(cart_for_c_read(99, values) == CART_FOR_C_BAD_ARGUMENT, "no such read-out");
    must(cart_for_c_read(0, 0) == CART_FOR_C_BAD_ARGUMENT, "a null pointer");
    must(cart_for_c_pose(99, position, orientation) == CART_FOR_C_BAD_ARGUMENT, "no such body");
    must(cart_for_c_restore(0, 0) == CART_FOR_C_BAD_ARGUMENT, "null bytes");
    must(cart_for_c_failure(why, sizeof why) == CART_FOR_C_OK && why[0] == 0, "no failure");
    must(cart_for_c_failure(why, 0) == CART_FOR_C_BAD_ARGUMENT, "no room");
    if (!failed) {
        print("every function as its header says\n");
    }
    return failed;
}
