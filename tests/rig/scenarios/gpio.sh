# libgpiod 2: the contract and every error of GpioLines on gpio-sim; then a quadrature encoder at its limit.
modprobe gpio-sim-oot
exec gpio_rig_tests --gtest_brief=1
