using System.Collections.Generic;
using System.Linq;
using System.Text.RegularExpressions;
using UnityEngine;

namespace Seedmesh
{
    /// <summary>Sets up an imported model: one LODGroup for all levels, and colliders of collision bodies.</summary>
    public static class SeedmeshLevels
    {
        /// <summary>Shares of the screen's height at which a level ends, as MSFT_screencoverage of the service has them.</summary>
        static readonly float[] Heights = { 0.5f, 0.25f, 0.12f, 0.06f, 0.01f };

        public static void SetUp(GameObject root)
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
            group.SetLODs(levels.Values.Select((renderers, index) =>
                new LOD(index == levels.Count - 1 ? 0 : Heights[Mathf.Min(index, Heights.Length - 1)], renderers.ToArray())).ToArray());
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
