# Every find_package of the project, with the oldest version tried and what it is for.

find_package(Eigen3 3.4 CONFIG REQUIRED) # vectors; CONFIG: VTK ships a FindEigen3 that shadows it
find_package(TBB 2021.8 REQUIRED)        # threads, behind core/parallel.h
find_package(nanoflann REQUIRED)         # nearest neighbours, behind core/point_index.h
find_package(Threads REQUIRED)

if(NOT PNEUMA_CORE_ONLY)
  find_package(CGAL 5.5 REQUIRED)                  # surfaces, private to geometry
  find_package(OpenCV 4.6 REQUIRED COMPONENTS core imgproc quality) # SSIM in render, image filters in segmentation
  find_package(nlohmann_json 3.11 REQUIRED)        # reports
  find_package(CLI11 2.1 REQUIRED)                 # command line
  find_package(OpenSSL 3.0 REQUIRED COMPONENTS Crypto) # SHA-256 of inputs
  find_package(LibArchive 3.6 REQUIRED)            # zipped series, private to io
  find_package(ZLIB REQUIRED)                      # compressed volumes, private to io
  # Single modules, never ${VTK_LIBRARIES}: modules tainted by MPI break the NRRD reader.
  find_package(
    VTK 9.1 REQUIRED
    COMPONENTS CommonColor CommonCore CommonDataModel CommonExecutionModel CommonMath CommonSystem CommonTransforms
               FiltersCore FiltersGeneral FiltersGeometry FiltersSources
               IOCore IOGeometry IOImage IOOggTheora IOPLY IOXML ImagingCore
               InteractionStyle RenderingCore RenderingFreeType RenderingOpenGL2)
  find_library(PNEUMA_HPDF hpdf REQUIRED)          # libharu: reports as PDF, private to pipeline
  find_package(DICOM 0.8 REQUIRED)                 # vtk-dicom: series of CT slices, private to io
  if(PNEUMA_BUILD_GUI)
    find_package(Qt5 5.15 REQUIRED COMPONENTS Core Gui Widgets Svg)
    find_package(VTK 9.1 REQUIRED COMPONENTS GUISupportQt)
  endif()
endif()

if(BUILD_TESTING)
  find_package(GTest 1.12 REQUIRED)
  if(PNEUMA_BUILD_GUI AND NOT PNEUMA_CORE_ONLY)
    find_package(Qt5 5.15 REQUIRED COMPONENTS Test)
  endif()
  if(NOT PNEUMA_CORE_ONLY)
    find_package(OpenCV 4.6 REQUIRED COMPONENTS videoio) # reads the films that render writes
  endif()
  find_program(PNEUMA_XVFB_RUN xvfb-run)
  # Real data, kept outside the project; tests that need them say so and run on generated data without.
  set(PNEUMA_TEST_DATA "$ENV{PNEUMA_TEST_DATA}" CACHE PATH "Folder of real data for the tests")
  set(PNEUMA_TEST_ENVIRONMENT "PNEUMA_TEST_DATA=${PNEUMA_TEST_DATA}" "LIBGL_ALWAYS_SOFTWARE=1"
                              "QT_LOGGING_RULES=qt.qpa.*=false")
endif()
if(PNEUMA_BUILD_BENCHMARKS)
  find_package(benchmark 1.7 REQUIRED)
  if(NOT PNEUMA_CORE_ONLY)
    find_package(VTK 9.1 REQUIRED COMPONENTS ImagingGeneral) # a general filter, as a reference
  endif()
endif()
