# Compiles shaders/STEM.STAGE to the header STEM_STAGE.h in the build tree.
# glslangValidator writes a depfile, so that a changed include is seen.
find_program(GLSLANG glslangValidator REQUIRED)
set(SLAMSCOPE_SHADER_DIR ${CMAKE_BINARY_DIR}/shaders_generated)
file(MAKE_DIRECTORY ${SLAMSCOPE_SHADER_DIR})

function(slamscope_shaders target)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/shaders/*.vert ${CMAKE_SOURCE_DIR}/shaders/*.frag
                                      ${CMAKE_SOURCE_DIR}/shaders/*.comp)
  foreach(source ${sources})
    cmake_path(GET source FILENAME name)
    string(REPLACE "." "_" name ${name})
    set(header ${SLAMSCOPE_SHADER_DIR}/${name}.h)
    add_custom_command(
      OUTPUT ${header}
      COMMAND ${GLSLANG} --quiet -V --target-env vulkan1.3 --vn ${name} --depfile ${header}.d
              -I${CMAKE_SOURCE_DIR}/shaders -o ${header} ${source}
      DEPENDS ${source}
      DEPFILE ${header}.d
      VERBATIM)
    list(APPEND headers ${header})
  endforeach()
  target_sources(${target} PRIVATE ${headers})
  target_include_directories(${target} PRIVATE ${SLAMSCOPE_SHADER_DIR})
endfunction()
