# The OpenCV modules that are used, without libopencv-dev: only that package has the CMake config, and
# it brings VTK and half a desktop with it. Defines slamscope_opencv (headers as system headers: they
# warn under C++20).
find_path(OPENCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4 REQUIRED)
add_library(slamscope_opencv INTERFACE)
target_include_directories(slamscope_opencv SYSTEM INTERFACE ${OPENCV_INCLUDE_DIR})
foreach(module core imgproc imgcodecs videoio calib3d)
  find_library(OPENCV_${module}_LIBRARY opencv_${module} REQUIRED)
  target_link_libraries(slamscope_opencv INTERFACE ${OPENCV_${module}_LIBRARY})
endforeach()
