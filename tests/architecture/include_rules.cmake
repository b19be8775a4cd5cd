# The rules of ARCHITECTURE.md that a compiler does not check, read off the files below ROOT.
#   cmake -DROOT=<source folder> -P include_rules.cmake
# Prints one line for every breach, and fails if there is one.
cmake_minimum_required(VERSION 3.25)

# What each module may use of ours beside itself, bottom to top.
set(MODULES core anatomy growth geometry lobes breathing segmentation io pipeline render)
set(core_MAY_USE "")
set(anatomy_MAY_USE core)
set(growth_MAY_USE core anatomy)
set(geometry_MAY_USE core)
set(lobes_MAY_USE core anatomy geometry)
set(breathing_MAY_USE core anatomy geometry)
set(segmentation_MAY_USE core anatomy geometry)
set(io_MAY_USE core anatomy)
set(pipeline_MAY_USE core anatomy growth geometry lobes breathing segmentation io)
set(render_MAY_USE core anatomy)

list(JOIN MODULES "|" OUR_FOLDERS)
string(APPEND OUR_FOLDERS "|app|cli|gui|views|tests|support")
set(MAX_LINES 450)

set_property(GLOBAL PROPERTY BREACHES "")
function(breach file sentence)
  message(NOTICE "${file}: ${sentence}")
  set_property(GLOBAL APPEND PROPERTY BREACHES "${file}")
endfunction()

# Breach if `header` matches `pattern` and `file` is none of `allowed` (both regular expressions).
function(restrict file header pattern allowed sentence)
  if(header MATCHES "${pattern}" AND NOT file MATCHES "${allowed}")
    breach(${file} "includes <${header}>; ${sentence}")
  endif()
endfunction()

function(check_third_party file header)
  restrict(${file} ${header} "^CGAL/" "^(modules/geometry|tests)/.*[.]cpp$"
           "CGAL belongs in the .cpp files of modules/geometry")
  restrict(${file} ${header} "^opencv" "^(modules/(segmentation|render)|tests/render)/.*[.]cpp$"
           "OpenCV belongs in the .cpp files of modules/segmentation and render, and in those that test render")
  restrict(${file} ${header} "^Q([A-Z]|t)" "^(app|tests)/gui/" "Qt belongs in app/gui")
  restrict(${file} ${header} "^vtk"
           "^(modules/render|app/gui|tests)/|^modules/(io|pipeline|segmentation)/.*[.]cpp$"
           "VTK belongs in render, and in the .cpp files of segmentation, io and pipeline")
  restrict(${file} ${header} "^(tbb|oneapi)/" "[.]cpp$"
           "TBB belongs in .cpp files, behind core/parallel.h")
  if(file MATCHES "^modules/(core|anatomy|growth)/"
     AND NOT header MATCHES "^([a-z_0-9]+|[a-z]mmintrin[.]h|(Eigen|tbb|oneapi)/.*|nanoflann[.]hpp)$")
    breach(${file} "includes <${header}>; core, anatomy and growth know only the standard library, \
Eigen, TBB and nanoflann")
  endif()
endfunction()

function(check_include file module line)
  if(line MATCHES "\"([^\"/]+)/")
    set(used ${CMAKE_MATCH_1})
    if(module AND used MATCHES "^(${OUR_FOLDERS})$" AND NOT used STREQUAL module
       AND NOT used IN_LIST ${module}_MAY_USE)
      breach(${file} "${module} must not include ${used}: arrows between modules point down only")
    endif()
  elseif(line MATCHES "<([^>]+)>")
    check_third_party(${file} ${CMAKE_MATCH_1})
  endif()
endfunction()

# Sources: includes and length.
file(GLOB_RECURSE sources RELATIVE "${ROOT}" "${ROOT}/modules/*.h" "${ROOT}/modules/*.cpp"
     "${ROOT}/app/*.h" "${ROOT}/app/*.cpp" "${ROOT}/tests/*.h" "${ROOT}/tests/*.cpp")
if(NOT sources)
  message(FATAL_ERROR "no sources below '${ROOT}'; give the source folder with -DROOT=")
endif()
foreach(file IN LISTS sources)
  set(module "")
  if(file MATCHES "^modules/([^/]+)/")
    set(module ${CMAKE_MATCH_1})
    if(NOT module IN_LIST MODULES)
      breach(${file} "the module ${module} is not in the table of include_rules.cmake")
    endif()
  endif()
  file(STRINGS "${ROOT}/${file}" lines REGEX "^[ \t]*#[ \t]*include")
  foreach(line IN LISTS lines)
    check_include(${file} "${module}" "${line}")
  endforeach()
  file(READ "${ROOT}/${file}" text)
  string(REGEX MATCHALL "\n" newlines "${text}")
  list(LENGTH newlines count)
  if(count GREATER MAX_LINES)
    breach(${file} "${count} lines; over ${MAX_LINES} it is two files")
  endif()
endforeach()

# Link lists: the same arrows.
foreach(module IN LISTS MODULES)
  if(EXISTS "${ROOT}/modules/${module}/CMakeLists.txt")
    file(READ "${ROOT}/modules/${module}/CMakeLists.txt" text)
    string(REGEX MATCHALL "pneuma::[a-z]+" links "${text}")
    foreach(link IN LISTS links)
      string(REPLACE "pneuma::" "" used ${link})
      if(NOT used IN_LIST ${module}_MAY_USE)
        breach(modules/${module}/CMakeLists.txt "${module} must not link ${used}")
      endif()
    endforeach()
  endif()
endforeach()

# No path of one person's machine anywhere in the project.
file(GLOB_RECURSE texts RELATIVE "${ROOT}" "${ROOT}/modules/*" "${ROOT}/app/*" "${ROOT}/tests/*"
     "${ROOT}/cmake/*" "${ROOT}/packaging/*" "${ROOT}/docs/*" "${ROOT}/resources/*" "${ROOT}/.ci/*")
file(GLOB top LIST_DIRECTORIES false RELATIVE "${ROOT}" "${ROOT}/*" "${ROOT}/.clang*")
foreach(file IN LISTS texts top)
  if(NOT file MATCHES "[.](png|svg|ico|qrc|gz)$")
    file(STRINGS "${ROOT}/${file}" lines REGEX "/(home|root|tmp|work|Users)/[A-Za-z]")
    if(lines)
      breach(${file} "names a path of one machine: ${lines}")
    endif()
  endif()
endforeach()

get_property(breaches GLOBAL PROPERTY BREACHES)
list(LENGTH breaches count)
if(count)
  message(FATAL_ERROR "${count} breaches of the rules in ARCHITECTURE.md")
endif()
list(LENGTH sources count)
message(STATUS "${count} sources keep the rules")
