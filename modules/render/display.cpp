#include "render/display.h"

#include <array>
#include <chrono>
#include <cstdlib>
#include <mutex>
#include <thread>

#include <dlfcn.h>
#include <poll.h>

namespace pneuma {
namespace {

/// A library of the window system, loaded only to ask; there may be none on a server.
class Library {
 public:
  explicit Library(const char* name) : handle_(dlopen(name, RTLD_LAZY | RTLD_LOCAL)) {}

  template <class Function>
  Function* function(const char* name) const {
    return handle_ == nullptr ? nullptr : reinterpret_cast<Function*>(dlsym(handle_, name));
  }

 private:
  void* handle_;  // stays loaded: unloading libraries of the window system is unsafe
};

int ignoreError(void* /*display*/, void* /*event*/) { return 0; }

/// True if a context of OpenGL 3.2 can be made, the least that VTK draws with: it would end the
/// process with less. An X server says no by an error, which ends the process unless it is caught.
bool makesContext(void* display, void* config, const Library& x11, const Library& gl) {
  using Handler = int (*)(void*, void*);
  using Procedure = void (*)();
  using Create = void* (*)(void*, void*, void*, int, const int*);
  auto* setHandler = x11.function<Handler(Handler)>("XSetErrorHandler");
  auto* sync = x11.function<int(void*, int)>("XSync");
  auto* procedure = gl.function<Procedure(const char*)>("glXGetProcAddressARB");
  auto* destroy = gl.function<void(void*, void*)>("glXDestroyContext");
  if (setHandler == nullptr || sync == nullptr || procedure == nullptr || destroy == nullptr) {
    return false;
  }
  const auto create = reinterpret_cast<Create>(procedure("glXCreateContextAttribsARB"));
  if (create == nullptr) return false;
  // Major and minor version, GLX_CONTEXT_PROFILE_MASK = core.
  constexpr std::array<int, 7> Wanted = {0x2091, 3, 0x2092, 2, 0x9126, 1, 0};
  const Handler before = setHandler(&ignoreError);
  void* context = create(display, config, nullptr, 1, Wanted.data());
  sync(display, 0);
  if (context != nullptr) destroy(display, context);
  sync(display, 0);
  setHandler(before);
  return context != nullptr;
}

bool hasOpenGl(void* display, const Library& x11) {
  auto* queryExtension = x11.function<int(void*, const char*, int*, int*, int*)>("XQueryExtension");
  auto* defaultScreen = x11.function<int(void*)>("XDefaultScreen");
  auto* freeMemory = x11.function<int(void*)>("XFree");
  const Library gl("libGL.so.1");
  auto* chooseConfig = gl.function<void*(void*, int, const int*, int*)>("glXChooseFBConfig");
  if (queryExtension == nullptr || defaultScreen == nullptr || freeMemory == nullptr ||
      chooseConfig == nullptr) {
    return false;
  }
  std::array<int, 3> ignored{};
  if (queryExtension(display, "GLX", &ignored[0], &ignored[1], &ignored[2]) == 0) return false;
  // GLX_RENDER_TYPE = GLX_RGBA_BIT, GLX_DOUBLEBUFFER = true: what VTK asks for.
  constexpr std::array<int, 5> Wanted = {0x8011, 0x1, 5, 1, 0};
  int count = 0;
  void* configs = chooseConfig(display, defaultScreen(display), Wanted.data(), &count);
  const bool draws = count > 0 && makesContext(display, *static_cast<void**>(configs), x11, gl);
  if (configs != nullptr) freeMemory(configs);
  return draws;
}

/// A connection that is kept for the rest of the process. An X server for tests starts afresh when
/// its last client leaves, and refuses whoever comes meanwhile; VTK would then end the process.
struct Connection {
  std::string name;
  void* display = nullptr;
  bool openGl = false;

  bool alive(const Library& x11) const {
    auto* descriptor = x11.function<int(void*)>("XConnectionNumber");
    if (display == nullptr || descriptor == nullptr) return false;
    pollfd connection{descriptor(display), 0, 0};
    return poll(&connection, 1, 0) >= 0 && (connection.revents & (POLLHUP | POLLERR)) == 0;
  }
};

void* opened(const Library& x11, const std::string& name) {
  auto* open = x11.function<void*(const char*)>("XOpenDisplay");
  if (open == nullptr) return nullptr;
  constexpr int Attempts = 4;
  void* display = open(name.c_str());
  for (int attempt = 1; display == nullptr && attempt < Attempts; ++attempt) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    display = open(name.c_str());
  }
  return display;
}

}  // namespace

std::string displayProblem() {
  const char* variable = std::getenv("DISPLAY");
  if (variable == nullptr || *variable == '\0') return "there is no display ($DISPLAY is not set)";
  const std::string name = variable;
  static std::mutex mutex;
  static Connection kept;
  const std::lock_guard lock(mutex);
  const Library x11("libX11.so.6");
  if (kept.name != name || !kept.alive(x11)) {
    // What was kept before is left open: closing a connection that died ends the process.
    void* display = opened(x11, name);
    if (display == nullptr) return "the display '" + name + "' does not answer";
    kept = {name, display, hasOpenGl(display, x11)};
  }
  return kept.openGl ? std::string() : "the display '" + name + "' has no OpenGL 3.2";
}

}  // namespace pneuma
