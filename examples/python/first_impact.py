# SPDX-License-Identifier: BSD-3-Clause
# A steel ball (radius 5 mm) hits polyisobutylene with 5 cm/s at three angles.
import restitute

polymer = restitute.material("polyisobutylene")
ball = restitute.pair(
    polymer, radius=0.005, density=7800, friction=0.3, speed=0.05, angle=[0, 30, 60]
)
print("ez =", ball.ez.round(3), "+-", ball.error_ez.max().round(4))
print("ex =", ball.ex.round(3), "+-", ball.error_ex.max().round(4))
