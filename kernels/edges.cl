// Edges: blackens the edges of a picture on a GPU, after its first hits. The batch is the whole picture, row-major,
// with CHANNEL_DISTANCE, CHANNEL_NORMAL and CHANNEL_IDS.
#include "traversal/camera.h"
#include "shading/edge.h"

// `surfaces`: the picture from CHANNEL_DISTANCE on; x, y: within the screen.
static edge_pixel pixel_of_picture(__global const Frame* frame, edge_camera camera, __global const float* surfaces,
                                   u32 x, u32 y) {
    const size_t size = channel_size(frame);
    edge_pixel p;
    surfaces += (size_t)y * width_of(frame->screen) + x;
    p.distance = surfaces[0];
    p.nx = surfaces[size];
    p.ny = surfaces[2 * size];
    p.nz = surfaces[3 * size];
    p.region = ((__global const u32*)surfaces)[4 * size];
    return edge_pixel_at(camera, (float)x, (float)y, p);
}

// One work-item a pixel, in the order of the rays. Nothing is done if some rays are not drawn: the host sees the same
// count in the report.
__kernel void draw_edges(__global const Frame* frame, __global const BatchReport* report, __global float* picture) {
    const u32 id = (u32)get_global_id(0), width = width_of(frame->screen), channels = frame->channels;
    const size_t size = channel_size(frame);
    __global const float* const surfaces = picture + (channels & CHANNEL_COLOR ? 4 * size : 0);
    __global u32* const display = (__global u32*)surfaces + (channels & CHANNEL_COUNTS ? 9 : 6) * size;
    edge_camera camera;
    edge_pixel own, other;
    pixel_position at;
    u32 x, y, is_black = 0;
    if (id >= frame->ray_count || report->overflows) return;
    if (!((__global const unsigned char*)(report + 1))[id / (TILE * TILE)]) return;  // the tile shows nothing
    at = pixel_of(id, frame->screen);
    if (!at.inside) return;
    x = at.x - frame->screen.left;
    y = at.y - frame->screen.top;
    camera = edge_camera_of(frame);
    own = pixel_of_picture(frame, camera, surfaces, x, y);
    if (x > 0) {
        other = pixel_of_picture(frame, camera, surfaces, x - 1, y);
        is_black |= edge_between(other, other.right, own, own.right, camera.slack) & 2u;
    }
    if (x + 1 < width) {
        other = pixel_of_picture(frame, camera, surfaces, x + 1, y);
        is_black |= edge_between(own, own.right, other, other.right, camera.slack) & 1u;
    }
    if (y > 0) {
        other = pixel_of_picture(frame, camera, surfaces, x, y - 1);
        is_black |= edge_between(other, other.down, own, own.down, camera.slack) & 2u;
    }
    if (y + 1 < frame->rows) {
        other = pixel_of_picture(frame, camera, surfaces, x, y + 1);
        is_black |= edge_between(own, own.down, other, other.down, camera.slack) & 1u;
    }
    if (!is_black) return;
    picture += (size_t)y * width + x;
    if (channels & CHANNEL_COLOR) picture[0] = picture[size] = picture[2 * size] = 0;
    if (channels & CHANNEL_DISPLAY) display[(size_t)y * width + x] = EDGE_WORD;
}
