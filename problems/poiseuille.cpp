// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: a fluid pushed along a channel: the parabolic profile; 5 s
//
// Plane Poiseuille flow from rest, exact at all times.
//
//     ===================  at rest     Both plates are no-slip walls, and every particle feels the same
//      o  o  o  o  o  o  o  -> g       force along them, 8 nu U/H^2 for each unit of mass. In the end
//      o  o  o  o  o  o  o  -> g       u = 4 U (y/H)(1 - y/H); on the way Fourier's series is exact.
//      o  o  o  o  o  o  o  -> g
//     ===================  at rest     periodic along the plates
#include "couette/channel.hpp"

int main(int argc, char** argv) {
    return channel::main_of(argc, argv, "poiseuille",
                            "plane Poiseuille flow from rest, against the exact profile",
                            channel::Drive::force);
}
