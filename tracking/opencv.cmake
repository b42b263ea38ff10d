# The OpenCV modules that are used, without libopencv-dev: only that package has the CMake config, and
# it brings VTK and half a desktop with it. Defines slamscope_opencv, and slamscope_opencv_codecs for the
# library that is only opened when it is needed (headers as system headers: they warn under C++20).
find_path(OPENCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4 REQUIRED)
function(slamscope_opencv_modules name)
  add_library(${name} INTERFACE)
  target_include_directories(${name} SYSTEM INTERFACE ${OPENCV_INCLUDE_DIR})
  foreach(module ${ARGN})
    find_library(OPENCV_${module}_LIBRARY opencv_${module} REQUIRED)
    target_link_libraries(${name} INTERFACE ${OPENCV_${module}_LIBRARY})
  endforeach()
endfunction()
slamscope_opencv_modules(slamscope_opencv core imgproc calib3d)
slamscope_opencv_modules(slamscope_opencv_codecs core imgcodecs videoio)
