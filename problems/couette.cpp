// SPDX-License-Identifier: GPL-3.0-or-later
// spam-list: a fluid between plates, one of which moves: the linear profile; 5 s
//
// Plane Couette flow from rest, exact at all times.
//
//     ===================  -> V        The plates are no-slip walls: images of the particles behind them
//      o  o  o  o  o  o  o             move with 2 V - v. Momentum diffuses from the moving plate until
//      o  o  o  o  o  o  o             u = V y/H; on the way Fourier's series is exact.
//      o  o  o  o  o  o  o
//     ===================  at rest     periodic along the plates
#include "couette/channel.hpp"

int main(int argc, char** argv) {
    return channel::main_of(argc, argv, "couette",
                            "plane Couette flow from rest, against the exact profile",
                            channel::Drive::plate);
}
