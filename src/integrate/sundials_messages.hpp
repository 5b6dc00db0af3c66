// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <spam/core/nvector.hpp>

#include <sundials/sundials_config.h>

namespace spam {

/// What SUNDIALS complains about, kept as text instead of printed. Before 7 each memory has a handler of
/// its own (handler()), later the context has, as long as a Scope lives.
class SundialsMessages {
  public:
    const std::string& text() const { return text_; }

#if SUNDIALS_VERSION_MAJOR >= 7
    class Scope {
      public:
        Scope(const SundialsContext& context, SundialsMessages& messages) : context_(context) {
            SUNContext_PushErrHandler(context.get(), &keep, &messages);
        }
        ~Scope() { SUNContext_PopErrHandler(context_.get()); }
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

      private:
        const SundialsContext& context_;
    };

  private:
    static void keep(int, const char*, const char*, const char* message, SUNErrCode, void* self,
                     SUNContext) {
        static_cast<SundialsMessages*>(self)->text_ = message != nullptr ? message : "";
    }
#else
    struct Scope {
        Scope(const SundialsContext&, SundialsMessages&) {}
    };
    static void handler(int, const char*, const char*, char* message, void* self) {
        static_cast<SundialsMessages*>(self)->text_ = message;
    }

  private:
#endif
    std::string text_;
};

}  // namespace spam
