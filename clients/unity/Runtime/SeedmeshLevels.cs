using System.Collections.Generic;
using System.Linq;
using System.Text.RegularExpressions;
using UnityEngine;

namespace Seedmesh
{
    /// <summary>Sets up an imported model: one LODGroup for all levels, and colliders of collision bodies.</summary>
    public static class SeedmeshLevels
    {
        /// <summary>`heights`: shares of the screen's height below which the coarser levels begin, as SeedmeshFile reads them.</summary>
        public static void SetUp(GameObject root, float[] heights)
        {
            foreach (var filter in root.GetComponentsInChildren<MeshFilter>(true).Where(each => IsCollision(each.name)))
            {
                var body = filter.gameObject.AddComponent<MeshCollider>();
                body.sharedMesh = filter.sharedMesh;
                body.convex = true;
                Object.DestroyImmediate(filter.GetComponent<MeshRenderer>());
            }
            var levels = new SortedDictionary<int, List<Renderer>>();
            foreach (var renderer in root.GetComponentsInChildren<Renderer>(true))
            {
                var level = LevelOf(renderer.name);
                if (!levels.ContainsKey(level)) levels[level] = new List<Renderer>();
                levels[level].Add(renderer);
            }
            if (levels.Count < 2) return;
            // Groups that the importer made for single meshes change at different distances.
            foreach (var old in root.GetComponentsInChildren<LODGroup>(true)) Object.DestroyImmediate(old);
            var group = root.AddComponent<LODGroup>();
            // Unity wants the height at which a level ends, falling; the coarsest has no end.
            group.SetLODs(levels.Values.Select((renderers, index) =>
                new LOD(index == levels.Count - 1 || index >= heights.Length ? 0 : heights[index], renderers.ToArray())).ToArray());
            group.RecalculateBounds();
        }

        static bool IsCollision(string name) => Regex.IsMatch(name, @"^(collision|UCX)_");

        static int LevelOf(string name)
        {
            var match = Regex.Match(name, @"_LOD(\d+)$");
            return match.Success ? int.Parse(match.Groups[1].Value) : 0;
        }
    }
}
