# The least device: a Cortex-A8, with NEON but without fused multiplication and integer division.
# Debian's own armhf packages do without NEON.
get_filename_component(CMAKE_SYSROOT ${CMAKE_CURRENT_LIST_DIR}/../build/sysroot/armhf ABSOLUTE)
set(CMAKE_SYSTEM_PROCESSOR armv7l)
# Since GCC 7 some parameters are passed in another way, about which it would inform.
set(CMAKE_CXX_FLAGS_INIT "-mcpu=cortex-a8 -mfpu=neon -mfloat-abi=hard -Wno-psabi")
set(triple arm-linux-gnueabihf)
set(emulator qemu-arm -cpu cortex-a8)
include(${CMAKE_CURRENT_LIST_DIR}/cross.cmake)
