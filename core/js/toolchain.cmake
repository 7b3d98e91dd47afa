# CMake's toolchain for WebAssembly: clang with Debian's libc++ for it (libc++-dev-wasm32, libclang-rt-dev-wasm32) and lld.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_CXX_COMPILER clang++)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
# Every browser and Node have had both since 2023.
set(CMAKE_CXX_FLAGS_INIT "-msimd128 -mbulk-memory")
# No main(): JavaScript calls functions, after _initialize() has run the constructors of globals.
set(CMAKE_EXE_LINKER_FLAGS_INIT -mexec-model=reactor)
# Programs of the machine that builds; headers and libraries of the other.
set(CMAKE_FIND_ROOT_PATH /usr/lib/wasm32-wasi /usr/include/wasm32-wasi)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
