/* Draws frames of a mesh by OpenGL ES 3 for the comparison, which starts it:
   gles mesa|PATH-OF-ANGLE MESH SAMPLES SIDE

       frame N    draws N frames and waits for each; the answer is the nanoseconds of the last
       look       the last frame's bytes, RGBA, row by row from the top

   Buffers, texture and program are made before anything is timed, and the picture stays where it was drawn.
   cc -O2 gles.c -o gles -ldl */
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl3.h>
#include <dlfcn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define EGL_FUNCTIONS(X)                                                                                            \
    X(PFNEGLGETPLATFORMDISPLAYPROC, eglGetPlatformDisplay)                                                          \
    X(PFNEGLINITIALIZEPROC, eglInitialize)                                                                          \
    X(PFNEGLBINDAPIPROC, eglBindAPI)                                                                                \
    X(PFNEGLCHOOSECONFIGPROC, eglChooseConfig)                                                                      \
    X(PFNEGLCREATECONTEXTPROC, eglCreateContext)                                                                    \
    X(PFNEGLCREATEPBUFFERSURFACEPROC, eglCreatePbufferSurface)                                                      \
    X(PFNEGLMAKECURRENTPROC, eglMakeCurrent)
#define GL_FUNCTIONS(X)                                                                                             \
    X(PFNGLATTACHSHADERPROC, glAttachShader)                                                                        \
    X(PFNGLBINDATTRIBLOCATIONPROC, glBindAttribLocation)                                                            \
    X(PFNGLBINDBUFFERPROC, glBindBuffer)                                                                            \
    X(PFNGLBINDFRAMEBUFFERPROC, glBindFramebuffer)                                                                  \
    X(PFNGLBINDRENDERBUFFERPROC, glBindRenderbuffer)                                                                \
    X(PFNGLBINDTEXTUREPROC, glBindTexture)                                                                          \
    X(PFNGLBLITFRAMEBUFFERPROC, glBlitFramebuffer)                                                                  \
    X(PFNGLBUFFERDATAPROC, glBufferData)                                                                            \
    X(PFNGLCHECKFRAMEBUFFERSTATUSPROC, glCheckFramebufferStatus)                                                    \
    X(PFNGLCLEARPROC, glClear)                                                                                      \
    X(PFNGLCLEARCOLORPROC, glClearColor)                                                                            \
    X(PFNGLCOMPILESHADERPROC, glCompileShader)                                                                      \
    X(PFNGLCREATEPROGRAMPROC, glCreateProgram)                                                                      \
    X(PFNGLCREATESHADERPROC, glCreateShader)                                                                        \
    X(PFNGLDISABLEPROC, glDisable)                                                                                  \
    X(PFNGLDRAWELEMENTSPROC, glDrawElements)                                                                        \
    X(PFNGLENABLEPROC, glEnable)                                                                                    \
    X(PFNGLENABLEVERTEXATTRIBARRAYPROC, glEnableVertexAttribArray)                                                  \
    X(PFNGLFINISHPROC, glFinish)                                                                                    \
    X(PFNGLFRAMEBUFFERRENDERBUFFERPROC, glFramebufferRenderbuffer)                                                  \
    X(PFNGLGENBUFFERSPROC, glGenBuffers)                                                                            \
    X(PFNGLGENFRAMEBUFFERSPROC, glGenFramebuffers)                                                                  \
    X(PFNGLGENRENDERBUFFERSPROC, glGenRenderbuffers)                                                                \
    X(PFNGLGENTEXTURESPROC, glGenTextures)                                                                          \
    X(PFNGLGETERRORPROC, glGetError)                                                                                \
    X(PFNGLGETINTEGERVPROC, glGetIntegerv)                                                                          \
    X(PFNGLGETPROGRAMIVPROC, glGetProgramiv)                                                                        \
    X(PFNGLGETSTRINGPROC, glGetString)                                                                              \
    X(PFNGLGETUNIFORMLOCATIONPROC, glGetUniformLocation)                                                            \
    X(PFNGLLINKPROGRAMPROC, glLinkProgram)                                                                          \
    X(PFNGLREADPIXELSPROC, glReadPixels)                                                                            \
    X(PFNGLRENDERBUFFERSTORAGEMULTISAMPLEPROC, glRenderbufferStorageMultisample)                                    \
    X(PFNGLSHADERSOURCEPROC, glShaderSource)                                                                        \
    X(PFNGLTEXIMAGE2DPROC, glTexImage2D)                                                                            \
    X(PFNGLTEXPARAMETERIPROC, glTexParameteri)                                                                      \
    X(PFNGLUNIFORM2FPROC, glUniform2f)                                                                              \
    X(PFNGLUNIFORM3FPROC, glUniform3f)                                                                              \
    X(PFNGLUNIFORMMATRIX4FVPROC, glUniformMatrix4fv)                                                                \
    X(PFNGLUSEPROGRAMPROC, glUseProgram)                                                                            \
    X(PFNGLVERTEXATTRIBPOINTERPROC, glVertexAttribPointer)                                                          \
    X(PFNGLVIEWPORTPROC, glViewport)
#define DECLARE(type, name) static type name##_;
EGL_FUNCTIONS(DECLARE)
GL_FUNCTIONS(DECLARE)

/* What the comparison writes: little-endian, then the vertices and the indices. */
struct mesh {
    float matrix[16], towards[3], ambient, diffuse, background[4];
    uint32_t texture_side, vertices, indices;
};

static const char *vertex_source =
    "#version 300 es\n"
    "in vec3 position; in vec3 normal; in vec2 uv;\n"
    "uniform mat4 matrix;\n"
    "out vec3 n; out vec2 t;\n"
    "void main() {\n"
    "  n = normal;\n"
    "  t = vec2(uv.x, 1.0 - uv.y);\n"
    "  gl_Position = matrix * vec4(position, 1.0);\n"
    /* OpenGL's row 0 is at the bottom: upside down, its samples and its rule for edges are those of a picture from the top. */
    "  gl_Position.y = -gl_Position.y;\n"
    "}\n";
static const char *fragment_source =
    "#version 300 es\n"
    "precision highp float; precision highp sampler2D;\n"
    "in vec3 n; in vec2 t;\n"
    "uniform sampler2D texels; uniform vec3 towards; uniform vec2 light;\n"
    "out vec4 colour;\n"
    "void main() {\n"
    "  float lit = light.x + light.y * max(dot(normalize(n), towards), 0.0);\n"
    "  colour = vec4(texture(texels, t).rgb * lit, 1.0);\n"
    "}\n";

/* The comparison shows this line as the reason why the renderer is missing. */
static void fail(const char *why) {
    puts(why);
    exit(1);
}

static void open_display(const char *library) {
    int mesa = !strcmp(library, "mesa");
    void *egl = dlopen(mesa ? "libEGL.so.1" : library, RTLD_NOW | RTLD_GLOBAL);
    if (!egl) fail(dlerror());
    void (*(*address)(const char *))(void) = (void (*(*)(const char *))(void))dlsym(egl, "eglGetProcAddress");
#define LOAD(type, name)                                                                                            \
    if (!(name##_ = (type)dlsym(egl, #name)) && !(name##_ = (type)address(#name))) fail("no function " #name);
    EGL_FUNCTIONS(LOAD)
    EGLAttrib angle[] = {0x3203, 0x3450 /* Vulkan */, 0x3209, 0x3487 /* SwiftShader */, 0x348F, 0x34A5 /* headless */,
                         EGL_NONE};
    EGLDisplay display = mesa ? eglGetPlatformDisplay_(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL)
                              : eglGetPlatformDisplay_(0x3202, EGL_DEFAULT_DISPLAY, angle);
    if (!display || !eglInitialize_(display, NULL, NULL)) fail("EGL does not start");
    eglBindAPI_(EGL_OPENGL_ES_API);
    EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_NONE}, found = 0;
    EGLConfig config;
    if (!eglChooseConfig_(display, wanted, &config, 1, &found) || !found) fail("EGL has no configuration");
    EGLint version[] = {EGL_CONTEXT_CLIENT_VERSION, 3, EGL_NONE}, size[] = {EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
    EGLContext context = eglCreateContext_(display, config, EGL_NO_CONTEXT, version);
    EGLSurface surface = eglCreatePbufferSurface_(display, config, size);
    if (!eglMakeCurrent_(display, surface, surface, context)) fail("EGL has no context");
    GL_FUNCTIONS(LOAD)
}

static void compile(GLuint program, GLenum kind, const char *source) {
    GLuint shader = glCreateShader_(kind);
    glShaderSource_(shader, 1, &source, NULL);
    glCompileShader_(shader);
    glAttachShader_(program, shader);
}

static void buffer(GLenum kind, const void *data, size_t bytes) {
    GLuint name;
    glGenBuffers_(1, &name);
    glBindBuffer_(kind, name);
    glBufferData_(kind, (GLsizeiptr)bytes, data, GL_STATIC_DRAW);
}

static GLuint target(int samples, int side) {
    GLuint frame, parts[2];
    glGenFramebuffers_(1, &frame);
    glBindFramebuffer_(GL_FRAMEBUFFER, frame);
    glGenRenderbuffers_(2, parts);
    for (int i = 0; i < 2; i++) {
        glBindRenderbuffer_(GL_RENDERBUFFER, parts[i]);
        glRenderbufferStorageMultisample_(GL_RENDERBUFFER, samples, i ? GL_DEPTH_COMPONENT24 : GL_RGBA8, side, side);
        glFramebufferRenderbuffer_(GL_FRAMEBUFFER, i ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                   parts[i]);
    }
    if (glCheckFramebufferStatus_(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) fail("the target cannot be drawn to");
    return frame;
}

int main(int count, char **words) {
    if (count != 5) fail("gles mesa|PATH-OF-ANGLE MESH SAMPLES SIDE");
    int samples = atoi(words[3]) > 1 ? atoi(words[3]) : 0, side = atoi(words[4]);
    struct mesh mesh;
    FILE *file = fopen(words[2], "rb");
    if (!file || fread(&mesh, sizeof mesh, 1, file) != 1) fail("there is no mesh");
    size_t texels_bytes = 4 * (size_t)mesh.texture_side * mesh.texture_side, vertex_bytes = 32 * (size_t)mesh.vertices,
           index_bytes = 4 * (size_t)mesh.indices;
    char *data = malloc(texels_bytes + vertex_bytes + index_bytes);
    if (!data || fread(data, texels_bytes + vertex_bytes + index_bytes, 1, file) != 1) fail("the mesh is too short");
    open_display(words[1]);

    GLint most = 0;
    glGetIntegerv_(GL_MAX_SAMPLES, &most);
    if (samples > most) fail("it has no multisampling");
    GLuint resolved = target(0, side), drawn = samples ? target(samples, side) : resolved, texture;
    glGenTextures_(1, &texture);
    glBindTexture_(GL_TEXTURE_2D, texture);
    glTexImage2D_(GL_TEXTURE_2D, 0, GL_RGBA8, (GLsizei)mesh.texture_side, (GLsizei)mesh.texture_side, 0, GL_RGBA,
                  GL_UNSIGNED_BYTE, data);
    glTexParameteri_(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri_(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    buffer(GL_ARRAY_BUFFER, data + texels_bytes, vertex_bytes);
    buffer(GL_ELEMENT_ARRAY_BUFFER, data + texels_bytes + vertex_bytes, index_bytes);
    free(data);
    GLuint program = glCreateProgram_();
    compile(program, GL_VERTEX_SHADER, vertex_source);
    compile(program, GL_FRAGMENT_SHADER, fragment_source);
    const char *names[] = {"position", "normal", "uv"};
    for (GLuint i = 0; i < 3; i++) {
        glBindAttribLocation_(program, i, names[i]);
        glEnableVertexAttribArray_(i);
        glVertexAttribPointer_(i, i < 2 ? 3 : 2, GL_FLOAT, GL_FALSE, 32, (void *)(uintptr_t)(12 * i));
    }
    glLinkProgram_(program);
    GLint linked = 0;
    glGetProgramiv_(program, GL_LINK_STATUS, &linked);
    if (!linked) fail("the program does not link");
    glUseProgram_(program);
    glUniformMatrix4fv_(glGetUniformLocation_(program, "matrix"), 1, GL_FALSE, mesh.matrix);
    glUniform3f_(glGetUniformLocation_(program, "towards"), mesh.towards[0], mesh.towards[1], mesh.towards[2]);
    glUniform2f_(glGetUniformLocation_(program, "light"), mesh.ambient, mesh.diffuse);
    glViewport_(0, 0, side, side);
    glEnable_(GL_DEPTH_TEST);
    glDisable_(GL_DITHER);
    glClearColor_(mesh.background[0], mesh.background[1], mesh.background[2], mesh.background[3]);
    if (glGetError_()) fail("OpenGL reports an error");
    printf("ready %s, %s\n", (const char *)glGetString_(GL_RENDERER), (const char *)glGetString_(GL_VERSION));
    fflush(stdout);

    char line[100];
    while (fgets(line, sizeof line, stdin)) {
        int frames = 0;
        if (sscanf(line, "frame %d", &frames) == 1) {
            struct timespec begin, end;
            for (int i = 0; i < frames; i++) {
                clock_gettime(CLOCK_MONOTONIC, &begin);
                glBindFramebuffer_(GL_FRAMEBUFFER, drawn);
                glClear_(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
                glDrawElements_(GL_TRIANGLES, (GLsizei)mesh.indices, GL_UNSIGNED_INT, NULL);
                if (samples) {
                    glBindFramebuffer_(GL_DRAW_FRAMEBUFFER, resolved);
                    glBlitFramebuffer_(0, 0, side, side, 0, 0, side, side, GL_COLOR_BUFFER_BIT, GL_NEAREST);
                }
                glFinish_();
                clock_gettime(CLOCK_MONOTONIC, &end);
            }
            printf("%lld\n", (long long)(end.tv_sec - begin.tv_sec) * 1000000000 + (end.tv_nsec - begin.tv_nsec));
        } else if (!strncmp(line, "look", 4)) {
            char *pixels = malloc(4 * (size_t)side * (size_t)side);
            if (!pixels) return 1;
            glBindFramebuffer_(GL_FRAMEBUFFER, resolved);
            glReadPixels_(0, 0, side, side, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
            fwrite(pixels, 4, (size_t)side * (size_t)side, stdout);
            free(pixels);
        }
        fflush(stdout);
    }
    return 0;
}
