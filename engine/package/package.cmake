# What `cmake --install` puts where: libraries, public headers, a config package, pkg-config files.
# Users write <firstray/engine/...>; inside the project it is "engine/...". The headers are turned from one into the other,
# so that nobody's include path gets a folder as common as `engine`.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(public_headers
    engine/aff/reader.h
    engine/core/aabb.h engine/core/errors.h engine/core/executor.h engine/core/precision.h engine/core/ray_tile.h
    engine/core/simd.h engine/core/transform.h
    engine/image/image.h
    engine/render/camera_rays.h engine/render/frame.h engine/render/frameless.h engine/render/render.h
    engine/render/texture.h
    engine/scene/meshes.h engine/scene/pose.h engine/scene/scene.h engine/scene/track.h
    engine/strategy/grid.h engine/strategy/list.h engine/strategy/outline.h engine/strategy/strategy.h
    engine/strategy/tracer.h
    lazy/calibrate.h lazy/lazy.h lazy/options.h lazy/rule.h
    obb/obb.h obb/options.h obb/smallest_obb.h
    bench/strategies.h)
set(public_include_dir ${PROJECT_BINARY_DIR}/include)  # also what the reference documents
file(REMOVE_RECURSE ${public_include_dir})
foreach(header IN LISTS public_headers)
    file(READ ${PROJECT_SOURCE_DIR}/${header} text)
    string(REPLACE "bench/strategies.h" "strategies.h" installed ${header})
    string(REGEX REPLACE "#include \"((engine|lazy|obb)/[^\"]+)\"" "#include <firstray/\\1>" text "${text}")
    file(WRITE ${public_include_dir}/firstray/${installed} "${text}")
    set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${header})
endforeach()

# The table of strategies without peers: Embree is for measuring.
add_library(own_strategies STATIC ${PROJECT_SOURCE_DIR}/bench/strategies.cpp)
add_library(firstray::strategies ALIAS own_strategies)
set_target_properties(own_strategies PROPERTIES EXPORT_NAME strategies)
target_link_libraries(own_strategies PUBLIC engine lazy obb PRIVATE $<BUILD_INTERFACE:firstray_flags>)

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/firstray)
foreach(target engine lazy obb own_strategies image)
    get_target_property(name ${target} EXPORT_NAME)
    if(NOT name)
        set(name ${target})
    endif()
    set_target_properties(${target} PROPERTIES OUTPUT_NAME firstray_${name})
    target_compile_features(${target} PUBLIC cxx_std_20)
    set(export firstrayTargets)
    if(name STREQUAL image)
        set(export firstrayImageTargets)  # apart: who does not ask for it need not have OpenImageIO
    endif()
    install(TARGETS ${target} EXPORT ${export} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endforeach()
install(EXPORT firstrayTargets NAMESPACE firstray:: DESTINATION ${config_dir} COMPONENT library)
install(EXPORT firstrayImageTargets NAMESPACE firstray:: DESTINATION ${config_dir} COMPONENT library)
install(DIRECTORY ${public_include_dir}/firstray DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT library)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/firstrayConfig.cmake.in
    ${PROJECT_BINARY_DIR}/package/firstrayConfig.cmake INSTALL_DESTINATION ${config_dir}
    NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/firstrayConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/package/firstrayConfig.cmake ${PROJECT_BINARY_DIR}/package/firstrayConfigVersion.cmake
    DESTINATION ${config_dir} COMPONENT library)

# A pkg-config file per library. The libraries are static, so that what they use is linked by whoever links them.
function(add_pkg_config name description requires libs)
    file(RELATIVE_PATH prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
    configure_file(${PROJECT_SOURCE_DIR}/engine/package/firstray.pc.in ${PROJECT_BINARY_DIR}/package/${name}.pc @ONLY)
    install(FILES ${PROJECT_BINARY_DIR}/package/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
        COMPONENT library)
endfunction()
pkg_check_modules(GLM QUIET glm)  # headers alone: where there is no such file they are in the default path
if(GLM_FOUND)
    set(glm glm)
else()
    set(glm "")
endif()
add_pkg_config(firstray-engine "scenes, rays, grids" "${glm}" "-lfirstray_engine -ltbb -lhwy")
add_pkg_config(firstray-lazy "grids built as rays enter them" firstray-engine -lfirstray_lazy)
add_pkg_config(firstray-obb "oriented boxes that move" firstray-engine -lfirstray_obb)
add_pkg_config(firstray-image "pictures, by OpenImageIO" "firstray-engine OpenImageIO" -lfirstray_image)
add_pkg_config(firstray "all strategies by name" "firstray-lazy firstray-obb" -lfirstray_strategies)

install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT library)

# The reference: what is installed, from its comments. One fault is one failed build.
find_package(Doxygen QUIET)
if(DOXYGEN_FOUND)
    configure_file(${CMAKE_CURRENT_LIST_DIR}/Doxyfile.in ${PROJECT_BINARY_DIR}/package/Doxyfile @ONLY)
    add_custom_target(docs COMMAND ${DOXYGEN_EXECUTABLE} ${PROJECT_BINARY_DIR}/package/Doxyfile
        COMMAND ${CMAKE_COMMAND} -E echo "${PROJECT_BINARY_DIR}/docs/html/index.html" VERBATIM)
else()
    message(STATUS "docs: no reference (doxygen not found)")
endif()
